// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <thread>
#include <vector>

#include "velum/context.hpp"

namespace velum::test {

/// A context for tests of functions: chunks on plain threads, measures and warnings kept.
class PlainContext final : public Context {
 public:
  explicit PlainContext(int threads = 1) : threads_(threads) {}
  std::map<std::string, double> measures;
  std::vector<std::string> warnings;
  bool stop = false;

  [[nodiscard]] int threads() const override { return threads_; }
  [[nodiscard]] Random random() const override { return Random(1); }
  void progress(double) override {}
  [[nodiscard]] bool cancelled() const noexcept override { return stop; }
  void warn(const std::string& message) override { warnings.push_back(message); }
  void info(const std::string&) override {}
  void measure(const std::string& name, double value, const std::string&, Better) override {
    measures[name] = value;
  }
  void run_chunks(Index chunks, const std::function<void(Index)>& body) override {
    check();
    std::vector<std::thread> others;
    for (int t = 1; t < threads_; ++t)
      others.emplace_back([&, t] {
        for (Index c = t; c < chunks; c += threads_) body(c);
      });
    for (Index c = 0; c < chunks; c += threads_) body(c);
    for (std::thread& other : others) other.join();
  }

 private:
  int threads_;
};

}  // namespace velum::test
