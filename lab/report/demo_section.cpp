// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

namespace hapnet::lab::report {

std::optional<Section> demo_section(const results::Results& results)
{
    if (!results.demo) return std::nullopt;
    Section section{"demo", "The demo beside the paper’s Table 1"};
    for (const records::TextTable& table : demo_tables(*results.demo)) add_table(section, table);
    section.add(page::paragraph(
        "While the left hand moves the cube in P1, the right copy is where the left one was 160 ms "
        "ago. Where x stays flat at its highest, the cube stands at the static cube. At the end "
        "both hands are off, and the copies agree again."));
    return section;
}

} // namespace hapnet::lab::report
