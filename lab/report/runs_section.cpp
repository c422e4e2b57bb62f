// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

/// "1 to 40" of whole numbers that follow one another; empty for what is none.
std::string range_of(const Json& list)
{
    if (list.size() < 3) return {};
    for (std::size_t i = 0; i < list.size(); ++i) {
        const bool follows = list[i].is_number_integer() &&
                             list[i].get<std::int64_t>() ==
                                 list[0].get<std::int64_t>() + static_cast<std::int64_t>(i);
        if (!follows) return {};
    }
    return fmt::format("{} to {}", list.front().get<std::int64_t>(),
                       list.back().get<std::int64_t>());
}

/// What a person reads of a value: texts without quotes, lists with commas.
std::string words_of(const Json& value)
{
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_null()) return "–";
    std::string out;
    if (value.is_array()) {
        if (auto range = range_of(value); !range.empty()) return range;
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

/// Objects in objects, such as the demo's configuration, are shown as JSON.
bool is_nested(const Json& value)
{
    return value.is_object() &&
           std::any_of(value.begin(), value.end(), [](const Json& one) { return one.is_object(); });
}

/// "speed_ratio" as "speed ratio", "wall_time_s" as "wall time, s".
std::string title_of_key(std::string key)
{
    if (key.ends_with("_s")) key.replace(key.size() - 2, 2, ", s");
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

/// The words of one value of a manifest; "–" when it is not there.
std::string words_at(const results::Run& run, std::string_view key)
{
    const auto found = run.manifest.find(key);
    return found == run.manifest.end() ? "–" : words_of(*found);
}

Json overview(const std::vector<results::Run>& runs)
{
    page::Table table{"What was run",
                      {"folder", "title", "wall time, s", "simulated, s",
                       "times faster\nthan real time", "sessions", "seeds", "valid"}};
    for (const results::Run& run : runs) {
        table.rows.push_back(
            {{run.folder},
             {words_at(run, "title"), "words"},
             {words_at(run, "wall_time_s")},
             {words_at(run, "simulated_s")},
             {words_at(run, "speed_ratio")},
             {words_at(run, "sessions"), "name"},
             {words_at(run, "seeds"), "name"},
             {run.is_valid() ? "valid" : "not valid", run.is_valid() ? "name" : "name missed"}});
    }
    return json_of(table);
}

/// All that a manifest says; what has lines of its own, such as the configuration, below the rest.
Json run_details(const results::Run& run)
{
    page::Table table{run.folder, {"", "value"}};
    Json blocks = Json::array({nullptr});
    for (const auto& [key, value] : run.manifest.items()) {
        const std::string words = is_nested(value) ? value.dump(2) : words_of(value),
                          title = title_of_key(key);
        if (words.find('\n') == std::string::npos) {
            table.rows.push_back({{title}, {words, "words"}});
        } else {
            blocks.push_back(page::paragraph(title + ":"));
            blocks.push_back(page::preformatted(words));
        }
    }
    blocks[0] = json_of(table);
    return page::folded(page::text_of({run.folder + ": ", page::code(words_at(run, "command"))}),
                        std::move(blocks));
}

} // namespace

std::optional<Section> runs_section(const results::Results& results)
{
    if (results.runs.empty()) return std::nullopt;
    Section section{"runs", "How to repeat it"};
    section.add(overview(results.runs));
    for (const results::Run& run : results.runs) section.add(run_details(run));
    return section;
}

} // namespace hapnet::lab::report
