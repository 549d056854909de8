// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/views.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace velum::report {
namespace {

/// Calls use(bytes) for each array of the view.
template <class Use>
void each_array(const View& view, const Use& use) {
  if (view.positions.there()) use(view.positions);
  if (view.triangles.there()) use(view.triangles);
  for (const ViewColumn& column : view.columns) use(column.data);
}

/// Views that are thinned together.
using Group = std::pair<Bytes::Key, bool>;
Group group_of(const View& view) {
  return {view.group, view.triangles.there()};
}

}  // namespace

void Views::add(View view) {
  std::erase_if(views_, [&](const View& each) { return each.id() == view.id(); });
  if (view.thinned == 0) view.group = view.positions.key();
  for (const View& other : views_) {
    if (!view.positions.there() || group_of(other) != group_of(view)) continue;
    while (view.thinned < other.thinned) view = thinner(view).value();
    break;
  }
  const auto key = [](const View& each) { return std::tuple(each.order, each.id()); };
  const auto place = std::ranges::lower_bound(views_, key(view), {}, key);
  views_.insert(place, std::move(view));
  keep_limit();
}

void Views::limit_to(std::uint64_t bytes) {
  limit_ = std::min(limit_, bytes);
  keep_limit();
}

std::uint64_t Views::bytes() const {
  std::set<Bytes::Key> known;
  std::uint64_t total = 0;
  for (const View& view : views_)
    each_array(view, [&](const Bytes& array) {
      if (known.insert(array.key()).second) total += array.size();
    });
  return total;
}

void Views::keep_limit() {
  while (bytes() > limit_ && thin_largest()) {
  }
}

bool Views::thin_largest() {
  std::map<Group, std::uint64_t> points;
  for (const View& view : views_)
    if (view.positions.there()) points[group_of(view)] = view.shown;
  std::vector<std::pair<std::uint64_t, Group>> groups;
  for (const auto& [group, shown] : points) groups.emplace_back(shown, group);
  std::ranges::sort(groups, std::greater<>());
  for (const auto& [shown, group] : groups) {
    bool thinned = false;
    for (View& view : views_) {
      if (!view.positions.there() || group_of(view) != group) continue;
      if (auto less = thinner(view)) {
        view = std::move(*less);
        thinned = true;
      }
    }
    if (thinned) return true;
  }
  return false;
}

}  // namespace velum::report
