// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <velum/stage.hpp>

#include "lms511/live.hpp"
#include "lms511/view.hpp"
#include "lms511/vrec.hpp"

namespace {

namespace lms = velum::lms511;

struct Recorder : lms::ScannerParameters {
  velum::OutputFile file;
  double rotate = 0.0;
  std::optional<velum::Duration> view;
  std::optional<velum::Angle> tilt_end;

  static auto about() {
    velum::About<Recorder> about("Keeps the raw telegrams of a SICK LMS 511 in a file.");
    about.out("table", "what was recorded")
        .param(&Recorder::file, "file", "the recording, a .vrec file")
        .required()
        .param(&Recorder::rotate, "rotate",
               "a new part (name.0001.vrec, ...) begins when one is larger; 0: never",
               velum::at_least(0.0))
        .unit("MB");
    lms::add_scanner<Recorder>(about);
    about
        .param(&Recorder::tilt_end, "tilt_end",
               "end the recording when the angles of the feed have passed this one")
        .param(&Recorder::view, "view", "show what comes that often", velum::above(0.0))
        .advanced()
        .nondeterministic()
        .uncached()
        .reference("SICK, telegram listing 8014631");
    return about;
  }

  void check() const { check_scanner(); }

  velum::Table operator()(velum::Context& context) const {
    lms::VrecWriter::Options options;
    options.rotate = static_cast<std::uint64_t>(1e6 * rotate);
    lms::VrecWriter writer(file.path, options);
    Watch watch(*this, writer, context);
    lms::Acquisition acquisition(ScannerParameters::acquisition(),
                                 {[&](const std::string& text) { context.warn(text); },
                                  [&](const std::string& text) { context.info(text); }},
                                 [&] { context.check(); });
    try {
      acquisition.run([&](const lms::Record& record) { watch.take(record); },
                      [&] { return watch.done(); });
    } catch (const velum::Cancelled&) {
      watch.end("interrupted");
      throw;
    } catch (const velum::Error& error) {
      if (error.fault() != velum::Fault::device) throw;
      watch.end(error.what());
      throw velum::Error(velum::Error(error.fault(), error.what()).at(error.where()))
          .hint(fmt::format("{} lines are in {}", watch.counts().lines, file.path.string()));
    }
    writer.close();
    return summary(watch.counts(), acquisition.counts(), writer, context);
  }

 private:
  // Looks at what goes into the file, and forgets it.
  class Watch {
   public:
    Watch(const Recorder& recorder, lms::VrecWriter& writer, velum::Context& context)
        : recorder_(recorder), writer_(writer), context_(context), begin_(lms::SteadyClock::now()) {
      lms::TiltSettings tilt{.source = lms::TiltSource::feed};
      if (recorder.tilt_end) tilt.end = *recorder.tilt_end;
      if (recorder.lines || recorder.duration || recorder.tilt_end) end_.emplace(recorder, tilt);
    }

    void take(const lms::Record& record) {
      if (end_ && end_->reached() && lms::is_telegram(record)) return;
      writer_.add(record);
      const bool line = gathered_.add(record);
      if (end_) {
        end_->see(gathered_);
        context_.progress(std::min(end_->share(), 1.0));
      }
      if (line && recorder_.view) view_.see(gathered_.lines().back());
      gathered_.drop_lines();
    }

    bool done() {
      draw();
      return end_ && end_->reached();
    }
    void end(const std::string& why) {
      const auto now = std::chrono::duration_cast<std::chrono::nanoseconds>(seconds());
      writer_.add({lms::Event::end, now.count(), why});
      writer_.close();
    }
    [[nodiscard]] const lms::LineCounts& counts() const { return gathered_.counts(); }

   private:
    [[nodiscard]] std::chrono::duration<double> seconds() const {
      return lms::SteadyClock::now() - begin_;
    }
    void draw() {
      const double now = seconds().count();
      if (!recorder_.view || now - drawn_ < recorder_.view->seconds) return;
      drawn_ = now;
      context_.info(view_.draw(counts(), now, end_ ? end_->share() : 0.0, writer_.written()));
    }

    const Recorder& recorder_;
    lms::VrecWriter& writer_;
    velum::Context& context_;
    lms::LineGatherer gathered_;
    std::optional<lms::SweepEnd> end_;
    lms::LiveView view_;
    lms::SteadyClock::time_point begin_;
    double drawn_ = 0.0;
  };

  static velum::Table summary(const lms::LineCounts& counts, const lms::Framer::Counts& wire,
                              const lms::VrecWriter& writer, velum::Context& context) {
    velum::Table table{{"figure", ""}, {"value", ""}};
    const auto add = [&](const char* name, std::uint64_t value, velum::Better better) {
      table.add({std::string(name), static_cast<std::int64_t>(value)});
      context.measure(name, static_cast<double>(value), "", better);
    };
    add("lines", counts.lines, velum::Better::neither);
    add("lost_lines", counts.lost, velum::Better::lower);
    add("malformed", counts.malformed, velum::Better::lower);
    add("gaps", counts.gaps, velum::Better::lower);
    add("connections", counts.connections, velum::Better::lower);
    add("bad_checksums", wire.bad_checksums, velum::Better::lower);
    add("bytes", writer.written(), velum::Better::neither);
    add("parts", writer.parts().size(), velum::Better::neither);
    return table;
  }
};

}  // namespace

VELUM_STAGE(Recorder)
