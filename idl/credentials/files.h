// The files of a folder of credentials: `collisionctl make-certificates` writes them, and every
// program that takes part in a secured world reads them (docker/SECURITY.md).
#pragma once

namespace collision::credentials {

inline constexpr char kIdentityCa[] = "identity_ca.pem";        ///< Who signs certificates.
inline constexpr char kCertificate[] = "identity.pem";          ///< Who the program is.
inline constexpr char kKey[] = "identity.key";                  ///< Its private key; secret.
inline constexpr char kPermissionsCa[] = "permissions_ca.pem";  ///< Who signs the documents below.
inline constexpr char kGovernance[] = "governance.p7s";    ///< What the world protects, and how.
inline constexpr char kPermissions[] = "permissions.p7s";  ///< What this program may do.

/// The variable of the environment that names the folder.
inline constexpr char kVariable[] = "COLLISION_CREDENTIALS";

}  // namespace collision::credentials
