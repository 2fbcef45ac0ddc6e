#include "client/programs/tools/certificates/profile.h"

namespace collision::client {

std::string SecurityProfile() {
  return R"(<!-- For a program of Cyclone DDS that does not use collisiond's library; the programs
     of collisiond need the variable COLLISION_CREDENTIALS alone. Beside a network profile:
     export COLLISION_CREDENTIALS=/path/to/this/folder
     profile=file:///path/to/cyclonedds-lan.xml
     export CYCLONEDDS_URI=$profile,file://$COLLISION_CREDENTIALS/cyclonedds-security.xml -->
<CycloneDDS>
  <Domain Id="any">
    <Security>
      <Authentication>
        <Library path="dds_security_auth" initFunction="init_authentication"
                 finalizeFunction="finalize_authentication"/>
        <IdentityCA>file:${COLLISION_CREDENTIALS}/identity_ca.pem</IdentityCA>
        <IdentityCertificate>file:${COLLISION_CREDENTIALS}/identity.pem</IdentityCertificate>
        <PrivateKey>file:${COLLISION_CREDENTIALS}/identity.key</PrivateKey>
      </Authentication>
      <Cryptographic>
        <Library path="dds_security_crypto" initFunction="init_crypto"
                 finalizeFunction="finalize_crypto"/>
      </Cryptographic>
      <AccessControl>
        <Library path="dds_security_ac" initFunction="init_access_control"
                 finalizeFunction="finalize_access_control"/>
        <PermissionsCA>file:${COLLISION_CREDENTIALS}/permissions_ca.pem</PermissionsCA>
        <Governance>file:${COLLISION_CREDENTIALS}/governance.p7s</Governance>
        <Permissions>file:${COLLISION_CREDENTIALS}/permissions.p7s</Permissions>
      </AccessControl>
    </Security>
  </Domain>
</CycloneDDS>
)";
}

}  // namespace collision::client
