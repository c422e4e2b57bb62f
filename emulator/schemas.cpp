// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/schemas.hpp"

#include "emulator/control/frame_report.hpp"
#include "emulator/control/run_statistics.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "emulator/tools/prediction_report.hpp"
#include "emulator/tools/probe_statistics.hpp"
#include "emulator/tools/verify/verify.hpp"
#include "proto/output/schema.hpp"

namespace hapnet::emulator {

std::vector<cli::DocumentSchema> schemas()
{
    const auto written = written_schemas();
    std::vector<cli::DocumentSchema> all{written.begin(), written.end()};
    all.push_back({.name = "statistics", .written = {}, .make = [] {
                       return output::schema_text<RunStatistics>(
                           "Statistics of hapnet-emulator (docs/formats/statistics.md)");
                   }});
    all.push_back({.name = "frame", .written = {}, .make = [] {
                       return output::schema_text<EmulatorFrame>(
                           "A frame of hapnet-emulator (docs/formats/live.md)");
                   }});
    all.push_back({.name = "predict", .written = {}, .make = [] {
                       return output::schema_text<tools::PredictionReport>(
                           "What hapnet-emulator predict --json prints (docs/use/emulator.md)");
                   }});
    all.push_back({.name = "learn", .written = {}, .make = [] {
                       return output::schema_text<tools::LearnReport>(
                           "What hapnet-emulator learn --json prints (docs/use/emulator.md)");
                   }});
    all.push_back({.name = "verify", .written = {}, .make = [] {
                       return output::schema_text<tools::Verification>(
                           "What hapnet-emulator verify --json prints (docs/use/emulator.md)");
                   }});
    all.push_back({.name = "probe", .written = {}, .make = [] {
                       return output::schema_text<tools::ProbeReport>(
                           "What hapnet-emulator probe --json prints (docs/use/probe.md)");
                   }});
    return all;
}

} // namespace hapnet::emulator
