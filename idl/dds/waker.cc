#include "idl/dds/waker.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace collision::dds {
namespace {

int MakeEvent() {
  const int event = eventfd(0, EFD_CLOEXEC);
  if (event < 0) throw std::runtime_error(std::string("eventfd: ") + std::strerror(errno));
  return event;
}

}  // namespace

Waker::Waker(dds_entity_t guard) : guard_(guard), event_(MakeEvent()), thread_([this] { Run(); }) {}

Waker::~Waker() {
  stopping_ = true;
  Wake();
  thread_.join();
  close(event_);
}

void Waker::Wake() noexcept {
  const int caller_errno = errno;
  const std::uint64_t one = 1;
  // It fails only if interrupted, or if 2^64 - 2 calls are unread: then the thread is about to
  // wake.
  while (write(event_, &one, sizeof one) < 0 && errno == EINTR) {
  }
  errno = caller_errno;
}

void Waker::Run() {
  while (!stopping_) {
    std::uint64_t calls = 0;
    if (read(event_, &calls, sizeof calls) == sizeof calls) dds_set_guardcondition(guard_, true);
  }
}

}  // namespace collision::dds
