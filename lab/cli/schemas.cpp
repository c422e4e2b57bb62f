// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/schemas.hpp"

#include "lab/cli/play_command.hpp"
#include "lab/hands/imitation.hpp"
#include "lab/hands/manifest.hpp"
#include "lab/records/analysis_report.hpp"
#include "lab/records/replay.hpp"
#include "lab/scenes/explain.hpp"
#include "proto/output/schema.hpp"

namespace hapnet::lab {

std::vector<cli::DocumentSchema> schemas()
{
    const auto written = written_schemas();
    std::vector<cli::DocumentSchema> all{written.begin(), written.end()};
    all.push_back({.name = "analysis", .written = {}, .make = [] {
                       return output::schema_text<records::AnalysisReport>(
                           "What hapnet-lab analyse --json prints (docs/formats/statistics.md)");
                   }});
    all.push_back({.name = "explanation", .written = {}, .make = [] {
                       return output::schema_text<scenes::Explanation>(
                           "What hapnet-lab explain --json prints (docs/formats/scene.md)");
                   }});
    all.push_back({.name = "fitted-hands", .written = {}, .make = [] {
                       return output::schema_text<hands::Imitation>(
                           "fit.json of hands fitted to recorded ones (docs/formats/hands.md)");
                   }});
    all.push_back({.name = "hands", .written = {}, .make = [] {
                       return output::schema_text<hands::Manifest>(
                           "manifest.json of a folder of recorded hands (docs/formats/hands.md)");
                   }});
    all.push_back({.name = "play", .written = {}, .make = [] {
                       return output::schema_text<PlayReport>(
                           "What hapnet-lab play --json prints (docs/use/experiments.md)");
                   }});
    all.push_back({.name = "replay", .written = {}, .make = [] {
                       return output::schema_text<records::Replayed>(
                           "What hapnet-lab replay --json prints (docs/formats/statistics.md)");
                   }});
    return all;
}

} // namespace hapnet::lab
