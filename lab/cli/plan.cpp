// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/plan.hpp"

#include "lab/cli/files.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hapnet::lab {

namespace {

constexpr int plan_format = 1;

} // namespace

std::string plan_at(const std::string& word)
{
    if (word.ends_with(".json")) return word;
    const auto inside = std::filesystem::path{word} / plan_name;
    return std::filesystem::exists(inside) ? inside.string() : "";
}

base::Result<Plan> read_plan(const std::string& path)
{
    const auto json = read_json(path);
    if (!json) return tl::unexpected{json.error()};
    try {
        if (json->at("format") != plan_format) return base::fail(path + ": a plan of another form");
        return Plan{.experiment = json->at("experiment"),
                    .overrides = {json->at("quick"), json->at("settings")},
                    .criteria = json->at("criteria"),
                    .files = json->at("files"),
                    .program = json->at("program")};
    } catch (const nlohmann::json::exception&) {
        return base::fail(path + ": not what `hapnet-lab plan` writes");
    }
}

void write_plan(const Plan& plan, const std::string& path)
{
    const nlohmann::ordered_json json{
        {"format", plan_format},         {"experiment", plan.experiment},
        {"quick", plan.overrides.quick}, {"settings", plan.overrides.settings},
        {"criteria", plan.criteria},     {"files", plan.files},
        {"program", plan.program}};
    disk::ResultFile{path}.commit(json.dump(2) + '\n');
}

base::OpenFile opener_of(const Plan& plan)
{
    return [files = plan.files](const std::string& name) -> base::Result<std::string> {
        const auto file = files.find(name);
        if (file == files.end()) return base::fail(name + " is not in the plan");
        return file->second;
    };
}

base::OpenFile opener_into(Plan& plan)
{
    return [&plan](const std::string& name) {
        auto text = net::text_of_file(name);
        if (text) plan.files.insert_or_assign(name, *text);
        return text;
    };
}

} // namespace hapnet::lab
