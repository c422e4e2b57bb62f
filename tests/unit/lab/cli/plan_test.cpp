// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/plan.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::lab {
namespace {

class PlanFile : public testing::Test {
protected:
    PlanFile()
        : path{(std::filesystem::temp_directory_path() /
                ("hapnet-plan-" + std::to_string(getpid()) + ".json"))
                   .string()}
    {
        Plan plan;
        plan.experiment = "qos.toml";
        plan.overrides = {true, {"seeds=3", "tasks=T1"}};
        plan.criteria = "known";
        plan.files = {{"qos.toml", "kind = \"plane\"\n"}, {"scene.toml", "[[body]]\n"}};
        plan.program = "hapnet-lab 1";
        write_plan(plan, path);
        whole = nlohmann::json::parse(std::ifstream{path});
    }
    PlanFile(const PlanFile&) = delete;
    PlanFile& operator=(const PlanFile&) = delete;
    ~PlanFile() override { std::filesystem::remove(path); }

    [[nodiscard]] std::string refusal_of(const nlohmann::json& json) const
    {
        std::ofstream{path} << json;
        const auto plan = read_plan(path);
        return plan ? "" : plan.error().message;
    }

    std::string path;
    nlohmann::json whole;
};

TEST_F(PlanFile, ReadsBackAsItWasWritten)
{
    const auto plan = read_plan(path);
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_EQ(plan->experiment, "qos.toml");
    EXPECT_TRUE(plan->overrides.quick);
    EXPECT_EQ(plan->overrides.settings, (std::vector<std::string>{"seeds=3", "tasks=T1"}));
    EXPECT_EQ(plan->criteria, "known");
    EXPECT_EQ(opener_of(*plan)("scene.toml").value(), "[[body]]\n");
    EXPECT_FALSE(opener_of(*plan)("/etc/passwd"));
    EXPECT_EQ(plan->program, "hapnet-lab 1");
}

TEST_F(PlanFile, IsRefusedWithoutAnyOfItsKeys)
{
    ASSERT_EQ(whole.size(), 7U);
    for (const auto& [key, value] : whole.items()) {
        auto without = whole;
        without.erase(key);
        EXPECT_EQ(refusal_of(without),
                  path + ": not what `hapnet-lab plan` writes: '" + key + "' is missing");
    }
}

TEST_F(PlanFile, IsRefusedWithAKeyOfAnotherType)
{
    const std::vector<std::pair<const char*, nlohmann::json>> wrong{
        {"format", "1"},         {"experiment", 5},     {"quick", 1},
        {"settings", "seeds=3"}, {"settings", {1}},     {"criteria", nullptr},
        {"files", true},         {"files", {{"a", 5}}}, {"program", {{"a", "b"}}}};
    for (const auto& [key, value] : wrong) {
        auto other = whole;
        other[key] = value;
        EXPECT_EQ(refusal_of(other),
                  path + ": not what `hapnet-lab plan` writes: '" + key + "' has another type")
            << value;
    }
    auto newer = whole;
    newer["format"] = 2;
    EXPECT_EQ(refusal_of(newer),
              path + ": a plan of format 2, and this program reads 1: plan again");
    EXPECT_EQ(refusal_of(5), path + " does not hold one JSON object");
}

} // namespace
} // namespace hapnet::lab
