// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"

#include "lab/report/words.hpp"
#include "proto/plot/axis.hpp"

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

/// A path of the page's folder as a link; what an address may not hold is percent-encoded.
std::string link_to(std::string_view path)
{
    constexpr std::string_view unreserved = "-._~/";
    std::string address;
    for (const char c : path) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') ||
                              unreserved.find(c) != std::string_view::npos;
        if (is_plain) {
            address += c;
        } else {
            address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return fmt::format("<a href='{}'>{}</a>", address, plot::escaped(path));
}

std::string sourced(std::string_view links)
{
    return links.empty() ? "" : fmt::format(" <span class='source'>Data: {}</span>", links);
}

} // namespace

void Section::add_figure(std::string name, std::string svg, std::string_view caption)
{
    html += figure(svg, std::string{caption} + sourced(sources));
    figures.push_back({plain_name(std::move(name)), std::move(svg)});
}

void Section::add_figure(std::string name, Drawing drawing, std::string_view caption)
{
    html += keep_figure(std::move(name), std::move(drawing), caption);
}

std::string Section::keep_figure(std::string name, Drawing drawing, std::string_view caption)
{
    name = plain_name(std::move(name));
    const std::string own = fmt::format("figures/{}.csv", name);
    auto out =
        fmt::format("<figure data-figure='{}'>\n{}<figcaption>{}{}</figcaption></figure>\n", name,
                    drawing.svg, caption, sourced(sources.empty() ? link_to(own) : sources));
    std::string csv = sources.empty() ? csv_of(drawing.data) : std::string{};
    figures.push_back(
        {std::move(name), std::move(drawing.svg), std::move(drawing.data), std::move(csv)});
    return out;
}

std::string links_to(const results::Results& results, std::string_view name)
{
    std::string links;
    for (const std::string& file : results.files) {
        if (file.substr(file.rfind('/') + 1) != name) continue;
        links += (links.empty() ? "" : ", ") + link_to(file);
    }
    return links;
}

} // namespace hapnet::lab::report
