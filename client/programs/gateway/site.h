// What the gateway answers to HTTP.
#pragma once

#include <mutex>
#include <string>

#include "client/programs/gateway/web/page_files.h"
#include "client/programs/gateway/web/web_types.h"
#include "client/programs/scene/past.h"
#include "client/programs/scene/shape_store.h"

namespace collision::gateway {

/// How the service is, as /readyz tells: "WELL: ..." and so on.
struct Readiness {
  bool is_ready = false;
  std::string text = "nothing has been heard yet";
};

/// Pages, shapes, and what probes ask for. Any thread.
class Site {
 public:
  /// `files` may be null: then there is no page. All outlive it.
  Site(const PageFiles* files, const client::ShapeStore* shapes, const client::Past* past)
      : files_(files), shapes_(*shapes), past_(*past) {}

  WebResponse Answer(const WebRequest& request) const;

  void SetReadiness(Readiness readiness);
  void SetMetrics(Payload metrics);

 private:
  WebResponse Shape(const std::string& name) const;

  const PageFiles* const files_;
  const client::ShapeStore& shapes_;
  const client::Past& past_;
  mutable std::mutex mutex_;
  Readiness readiness_;  ///< Guarded by it, as is all below.
  Payload metrics_;
};

}  // namespace collision::gateway
