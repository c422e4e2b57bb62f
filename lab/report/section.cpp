// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"

#include "lab/report/words.hpp"

#include <utility>

namespace hapnet::lab::report {

void Section::add_figure(std::string name, std::string svg, std::string_view caption)
{
    // Parts of the name come from files: it must stay a name.
    for (char& c : name) {
        const bool is_plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!is_plain) c = '-';
    }
    html += figure(svg, caption);
    figures.push_back({std::move(name), std::move(svg)});
}

} // namespace hapnet::lab::report
