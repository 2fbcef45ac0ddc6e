// Where published contacts are kept, as an interface.
#pragma once

#include <cstdint>
#include <string>

#include "idl/messages.pb.h"

namespace collision::server {

/// Takes the contacts that a service publishes. One thread.
class ContactSink {
 public:
  virtual ~ContactSink() = default;

  /// As published: contacts and crossings of levels, each revision.
  virtual void Add(const v1::CollisionEvent& contact) = 0;

  /// The step is over.
  virtual void Write(std::int64_t wall_ns) = 0;

  /// One line with path and cause, while nothing is kept for that reason; else empty.
  virtual const std::string& failure() const = 0;
};

}  // namespace collision::server
