// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "report/views.hpp"
#include "run/observer.hpp"

namespace velum::report {

/// Reduces what nodes make to views while a run goes on, and keeps nothing else of it.
class ViewWatch final : public run::Witness {
 public:
  /// `limit`: bytes of all views. `threads`: for measuring distances. `only`: names of the nodes
  /// that are looked at; empty: all.
  ViewWatch(const graph::Graph& graph, std::uint64_t limit, int threads,
            std::set<std::string> only = {});

  [[nodiscard]] bool wants(const graph::Node& node) const override;
  [[nodiscard]] bool wants_inputs(const graph::Node& node) const override;
  void made(const graph::Node& node, const std::vector<Wired>& inputs,
            const Results& results) override;

  /// What there is so far, in the graph's order.
  [[nodiscard]] Views views() const;
  /// Values that could not be shown, and why; one line each.
  [[nodiscard]] std::vector<std::string> troubles() const;

 private:
  void look(const graph::Node& node, const std::vector<Wired>& inputs, const Results& results);

  std::map<std::string, std::size_t> order_;  ///< of nodes
  int threads_;
  std::set<std::string> only_;
  mutable std::mutex mutex_;
  Views views_;
  std::vector<std::string> troubles_;
};

/// Bytes of the arrays of a run's report, before base64: what leaves room for the page (2 MB) and
/// the record within 20 MB.
inline constexpr std::uint64_t kRunLimit = 13'000'000;

}  // namespace velum::report
