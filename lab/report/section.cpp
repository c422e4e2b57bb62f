// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"

#include "lab/report/words.hpp"

#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

/// Parts of the name come from files: it must stay a name.
std::string plain_name(std::string name)
{
    for (char& c : name) {
        const bool is_plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!is_plain) c = '-';
    }
    return name;
}

} // namespace

void Section::add_figure(std::string name, std::string svg, std::string_view caption)
{
    html += figure(svg, caption);
    figures.push_back({plain_name(std::move(name)), std::move(svg)});
}

void Section::add_figure(std::string name, Drawing drawing, std::string_view caption)
{
    name = plain_name(std::move(name));
    html += fmt::format("<figure data-figure='{}'>\n{}<figcaption>{}</figcaption></figure>\n", name,
                        drawing.svg, caption);
    figures.push_back({std::move(name), std::move(drawing.svg), std::move(drawing.data)});
}

} // namespace hapnet::lab::report
