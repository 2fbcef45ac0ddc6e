/* The access control of an attacker: that of Cyclone DDS, but it lets its own program do whatever it
 * likes. So what is refused is refused by the others. It has the name of the true one, and is found
 * first (LD_LIBRARY_PATH). */
#include <dds/security/dds_security_api.h>
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>

struct ddsi_domaingv;
typedef int32_t (*Initialize)(const char* argument, void** context, struct ddsi_domaingv* domain);
typedef int32_t (*Finalize)(void* context);

static DDS_Security_boolean AllowWriter(dds_security_access_control* instance,
                                        const DDS_Security_PermissionsHandle permissions,
                                        const DDS_Security_DomainId domain,
                                        const DDS_Security_char* topic, const DDS_Security_Qos* qos,
                                        const DDS_Security_PartitionQosPolicy* partition,
                                        const DDS_Security_DataTags* tags,
                                        DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)partition;
  (void)tags, (void)exception;
  return 1;
}

static DDS_Security_boolean AllowTopic(dds_security_access_control* instance,
                                       const DDS_Security_PermissionsHandle permissions,
                                       const DDS_Security_DomainId domain,
                                       const DDS_Security_char* topic, const DDS_Security_Qos* qos,
                                       DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)exception;
  return 1;
}

static void* Find(const char* function) {
  void* library = dlopen(COLLISION_ACCESS_CONTROL, RTLD_NOW | RTLD_LOCAL);
  void* found = library == NULL ? NULL : dlsym(library, function);
  if (found == NULL) fprintf(stderr, "permissive access control: %s\n", dlerror());
  return found;
}

__attribute__((visibility("default"))) int32_t
init_access_control(const char* argument, void** context, struct ddsi_domaingv* domain) {
  const Initialize initialize = (Initialize)Find("init_access_control");
  const int32_t result = initialize == NULL ? -1 : initialize(argument, context, domain);
  if (result != 0) return result;
  dds_security_access_control* control = (dds_security_access_control*)*context;
  control->check_create_datawriter = AllowWriter;
  control->check_create_datareader = AllowWriter;
  control->check_create_topic = AllowTopic;
  printf("permissive\n");
  fflush(stdout);
  return 0;
}

__attribute__((visibility("default"))) int32_t
finalize_access_control(void* context) {
  const Finalize finalize = (Finalize)Find("finalize_access_control");
  return finalize == NULL ? -1 : finalize(context);
}
