// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/schemas.hpp"

#include "peer/doctor/report.hpp"
#include "proto/output/schema.hpp"

namespace hapnet::peer {

std::vector<cli::DocumentSchema> schemas()
{
    const auto written = written_schemas();
    std::vector<cli::DocumentSchema> all{written.begin(), written.end()};
    all.push_back({.name = "doctor", .written = {}, .make = [] {
                       return output::schema_text<doctor::Examination>(
                           "What hapnet-peer doctor --json prints (docs/formats/statistics.md)");
                   }});
    return all;
}

} // namespace hapnet::peer
