#include "idl/dds/entity.h"

#include <stdexcept>

namespace collision::dds {

dds_entity_t Check(dds_return_t result, const std::string& what) {
  if (result >= 0) return result;
  if (result == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY) {
    throw std::runtime_error(what + ": not allowed by the permissions of these credentials");
  }
  throw std::runtime_error(what + ": " + dds_strretcode(result) +
                           ": see what is said above of the network profile (CYCLONEDDS_URI) and "
                           "its interface; collisionctl doctor tells more");
}

}  // namespace collision::dds
