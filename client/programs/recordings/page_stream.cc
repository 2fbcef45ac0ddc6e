#include "client/programs/recordings/page_stream.h"

#include <limits>
#include <utility>

#include "client/programs/scene/item.h"
#include "collision/shape.h"

namespace collision::client {

PageStream::PageStream(std::unique_ptr<Receiver> receiver)
    : monitor_(std::move(receiver), scene_.Callbacks()) {}

std::vector<Board::Item> PageStream::TakeNew(double step) {
  const auto& status = scene_.view().status();
  if (!begun_ && status) begun_ = status->stamp();
  changes_ = scene_.TakeChanges();
  for (const std::string& hash : changes_.shapes) {
    board_.Put("bytes/" + HexText(hash), MakeItem(ItemKind::kShape, hash + *shapes_.Find(hash)));
  }
  items_.Put(scene_, changes_,
             {.service_alive = monitor_.service_alive(),
              .contacts_missed = monitor_.contacts_missed(),
              .unreadable = monitor_.unreadable()});
  Board::News news = board_.After(seen_, std::numeric_limits<std::size_t>::max());
  seen_ = news.seen;
  std::string states = scene_.states().PackAfter(seen_states_, step);
  seen_states_ = scene_.states().newest_change();
  if (!states.empty()) {
    news.items.push_back({"states", MakeItem(ItemKind::kChangedStates, std::move(states))});
  }
  return std::move(news.items);
}

bool PageStream::IsOver() const {
  const auto& status = scene_.view().status();
  return begun_ && status && status->stamp().service_id() == begun_->service_id() &&
         status->stamp().epoch() != begun_->epoch();
}

void PageStream::BeginAnew() {
  seen_ = seen_states_ = 0;
  begun_.reset();
}

}  // namespace collision::client
