#include "client/programs/tools/collisionctl/events/event_printer.h"

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "collision/event_text.h"

namespace collision::client {

void EventPrinter::PrintCurrent(WorldView* view) {
  for (const v1::CollisionEvent& event : selection_.Of(view->TakeNewestRevisions(), *view)) {
    Print(event, *view);
  }
  out_.flush();
}

void EventPrinter::PrintNew(WorldView* view, const std::string& told) {
  for (const v1::CollisionEvent& event : view->TakeEvents()) {
    if (selection_.Takes(event, *view)) Print(event, *view, told);
  }
  out_.flush();
}

void EventPrinter::PrintGap(std::uint64_t missed) {
  if (missed > missed_) {
    const std::uint64_t more = missed - missed_;
    out_ << (format_.json ? GapJson(more, missed) : MissedLine(more, missed)) << std::endl;
  }
  missed_ = missed;
}

void EventPrinter::Print(const v1::CollisionEvent& message, const WorldView& view,
                         const std::string& told) {
  const Event event = FromMessage(message);
  const auto name = [&view](const AgentId& id) { return view.Name(id); };
  const auto full_name = [&view](const AgentId& id) { return view.FullName(id); };
  const std::string sentence =
      format_.explain ? EventSentence(event, full_name, NowOf(message, view), 0) : "";
  if (format_.json) {
    out_ << EventJson(message, view, sentence, told) << '\n';
  } else {
    out_ << told << (told.empty() ? "" : "  ")
         << (format_.explain ? sentence : EventLine(event, name, 0)) << '\n';
  }
}

}  // namespace collision::client
