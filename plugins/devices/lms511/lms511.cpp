// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <velum/stage.hpp>

#include "lms511/live.hpp"
#include "lms511/vrec.hpp"

namespace {

namespace lms = velum::lms511;

struct Lms511 : lms::ScannerParameters, lms::SweepParameters {
  std::optional<velum::OutputFile> record;

  static auto about() {
    velum::About<Lms511> about("One sweep of a SICK LMS 511 over TCP.");
    about.out("cloud", "in the scanner's own frame").drops_columns();
    lms::add_scanner<Lms511>(about);
    lms::add_sweep<Lms511>(about);
    about
        .param(&Lms511::record, "record",
               "also keep all telegrams in this .vrec file; what was scanned before a failure is "
               "then not lost")
        .nondeterministic()
        .uncached()
        .reference("SICK, telegram listing 8014631")
        .reference("Canciani, thesis, 2.3 (scanner), 4.1 and 4.2 (two scanners on a trigger)");
    return about;
  }

  void check() const {
    check_scanner();
    check_sweep();
    static_cast<void>(lms::SweepEnd(*this, sweep().tilt));
  }

  velum::Cloud operator()(velum::Context& context) const {
    lms::LineGatherer gathered;
    lms::SweepEnd end(*this, sweep().tilt);
    std::unique_ptr<lms::VrecWriter> file;
    if (record) file = std::make_unique<lms::VrecWriter>(record->path, lms::VrecWriter::Options{});
    const auto sink = [&](const lms::Record& one) {
      if (end.reached() && lms::is_telegram(one)) return;
      if (file) file->add(one);
      gathered.add(one);
      end.see(gathered);
      context.progress(std::min(end.share(), 1.0));
    };
    scan(
        sink, [&] { return end.reached(); }, file.get(), gathered, context);
    if (file) file->close();
    lms::SweepCounts swept;
    velum::Cloud cloud = lms::make_sweep(gathered, sweep(), swept, context);
    lms::report(gathered, swept, context);
    return cloud;
  }

 private:
  void scan(const lms::RecordSink& sink, const std::function<bool()>& done, lms::VrecWriter* file,
            const lms::LineGatherer& gathered, velum::Context& context) const {
    lms::Acquisition acquisition(acquisition_settings(),
                                 {[&](const std::string& text) { context.warn(text); },
                                  [&](const std::string& text) { context.info(text); }},
                                 [&] { context.check(); });
    try {
      acquisition.run(sink, done);
    } catch (const velum::Error& error) {
      if (error.fault() != velum::Fault::device) throw;
      if (file != nullptr) file->close();
      throw velum::Error(velum::Error(error.fault(), error.what()).at(error.where()))
          .hint(hint(error, gathered.counts().lines));
    }
    const lms::Framer::Counts& wire = acquisition.counts();
    context.measure("bad_checksums", static_cast<double>(wire.bad_checksums), "",
                    velum::Better::lower);
    context.measure("garbage", static_cast<double>(wire.skipped_bytes), "bytes",
                    velum::Better::lower);
    context.measure("connections", static_cast<double>(gathered.counts().connections), "",
                    velum::Better::lower);
  }

  [[nodiscard]] lms::Acquisition::Settings acquisition_settings() const {
    return lms::ScannerParameters::acquisition();
  }

  [[nodiscard]] std::string hint(const velum::Error& error, std::uint64_t count) const {
    if (!error.hint().empty()) return error.hint();
    if (count == 0) return "is the scanner switched on, and the address right?";
    if (record)
      return fmt::format("{} lines that were scanned before are in {}: devices.replay reads it",
                         count, record->path.string());
    return fmt::format("{} lines were scanned before; with record = \"FILE.vrec\" they are kept",
                       count);
  }
};

}  // namespace

VELUM_STAGE(Lms511)
