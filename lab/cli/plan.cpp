// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/plan.hpp"

#include "lab/cli/files.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab {

namespace {

constexpr int plan_format = 1;

/// Reads the members of a plan, each into its own variable. Keeps the first error.
class PlanMembers {
public:
    PlanMembers(const nlohmann::ordered_json& json, const std::string& path)
        : json_{json}, path_{path}
    {}

    template <typename Value>
    Value take(const char* key)
    {
        const auto found = json_.find(key);
        try {
            if (found != json_.end()) return found->template get<Value>();
            refuse(key, "is missing");
        } catch (const nlohmann::json::exception&) {
            refuse(key, "has another type");
        }
        return {};
    }
    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

private:
    void refuse(const char* key, const char* why)
    {
        if (error_) return;
        error_ = fmt::format("{}: not what `hapnet-lab plan` writes: '{}' {}", path_, key, why);
    }

    const nlohmann::ordered_json& json_;
    const std::string& path_;
    std::optional<std::string> error_;
};

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
    PlanMembers members{*json, path};
    Plan plan;
    const auto format = members.take<std::int64_t>("format");
    plan.experiment = members.take<std::string>("experiment");
    plan.overrides.quick = members.take<bool>("quick");
    plan.overrides.settings = members.take<std::vector<std::string>>("settings");
    plan.criteria = members.take<std::string>("criteria");
    plan.files = members.take<std::map<std::string, std::string>>("files");
    plan.program = members.take<std::string>("program");
    if (members.error()) return base::fail(*members.error());
    if (format != plan_format) {
        return base::fail(fmt::format("{}: a plan of format {}, and this program reads {}: plan "
                                      "again",
                                      path, format, plan_format));
    }
    return plan;
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
