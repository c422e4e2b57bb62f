// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/plot/axis.hpp"
#include "lab/core/report/section.hpp"
#include "lab/core/report/words.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;
using Json = nlohmann::ordered_json;

namespace {

/// What a person reads of a value: texts without quotes, lists with commas.
std::string words_of(const Json& value)
{
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (value.is_null()) return "–";
    std::string out;
    if (value.is_array()) {
        for (const Json& one : value) out += (out.empty() ? "" : ", ") + words_of(one);
        return out;
    }
    if (value.is_object()) {
        for (const auto& [key, one] : value.items()) {
            out += (out.empty() ? "" : ", ") + key + " " + words_of(one);
        }
        return out;
    }
    return value.dump();
}

/// "speed_ratio" as "speed ratio".
std::string title_of_key(std::string key)
{
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

std::string run_html(const Run& run)
{
    const auto title = run.manifest.find("title");
    const std::string caption = title == run.manifest.end()
                                    ? run.folder
                                    : fmt::format("{}: {}", run.folder, words_of(*title));
    HtmlTable table{caption, {"", "value"}};
    std::string configuration;
    for (const auto& [key, value] : run.manifest.items()) {
        if (key == "title") continue;
        if (key == "configuration") {
            configuration = value.is_string() ? value.get<std::string>() : value.dump(2);
            continue;
        }
        table.rows.push_back({{escaped(title_of_key(key))}, {escaped(words_of(value)), "words"}});
    }
    std::string out = html_of(table);
    if (!configuration.empty()) {
        out += folded("Effective configuration", "<pre>" + escaped(configuration) + "</pre>\n");
    }
    return out;
}

} // namespace

std::optional<Section> runs_section(const Results& results)
{
    if (results.runs.empty()) return std::nullopt;
    Section section{"runs", "How to repeat it"};
    for (const Run& run : results.runs) section.html += run_html(run);
    return section;
}

} // namespace hapnet::lab::report
