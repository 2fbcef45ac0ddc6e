/* What Cyclone DDS knows of its domain. */
#include "idl/dds/security/domain_facts.h"

#include "dds/ddsi/ddsi_domaingv.h"
#include "dds/ddsi/ddsi_sertype.h"

static const struct ddsi_domaingv* Domain(const struct ddsi_sertype* type) {
  return (const struct ddsi_domaingv*)ddsrt_atomic_ldvoidp(&type->gv);
}

const char* CollisionOpenInterface(const struct ddsi_sertype* type) {
  const struct ddsi_domaingv* domain = Domain(type);
  for (int i = 0; i < domain->n_interfaces; ++i) {
    if (!domain->interfaces[i].loopback) return domain->interfaces[i].name;
  }
  return NULL;
}

int CollisionProfileSecures(const struct ddsi_sertype* type) {
#ifdef DDS_HAS_SECURITY
  return Domain(type)->config.omg_security_configuration != NULL;
#else
  (void)type;
  return 0;
#endif
}
