// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/schemas.hpp"

#include "peer/doctor/report.hpp"
#include "peer/monitor/statistics.hpp"
#include "peer/self_test/report.hpp"
#include "proto/output/schema.hpp"
#include "proto/telemetry/frame.hpp"

namespace hapnet::peer {

std::vector<cli::DocumentSchema> schemas()
{
    const auto written = written_schemas();
    std::vector<cli::DocumentSchema> all{written.begin(), written.end()};
    all.push_back({.name = "statistics", .written = {}, .make = [] {
                       return output::schema_text<monitor::PeerStatistics>(
                           "Statistics of hapnet-peer (docs/formats/statistics.md)");
                   }});
    all.push_back({.name = "frame", .written = {}, .make = [] {
                       return output::schema_text<telemetry::Frame>(
                           "A frame of hapnet-peer (docs/formats/live.md)");
                   }});
    all.push_back({.name = "doctor", .written = {}, .make = [] {
                       return output::schema_text<doctor::Examination>(
                           "What hapnet-peer doctor --json prints (docs/formats/statistics.md)");
                   }});
    all.push_back({.name = "self-test", .written = {}, .make = [] {
                       return output::schema_text<self_test::SelfTestReport>(
                           "What hapnet-peer self-test --json writes (docs/use/hardware.md)");
                   }});
    return all;
}

} // namespace hapnet::peer
