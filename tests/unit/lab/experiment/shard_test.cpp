// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/parts.hpp"
#include "lab/experiment/shard.hpp"
#include "lab/experiment/text.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::experiment {
namespace {

Experiment plane()
{
    return *parse_experiment(R"(
kind = "plane"
seeds = 5
algorithms = ["base", "sep"]
tasks = ["T1", "T3"]
[plane]
delay = ["0ms", "40ms", "80ms"]
jitter = ["0ms"]
loss = ["0%", "50%"]
)",
                             "test.toml");
}

std::string label(const Job& job) { return key_of(std::get<SessionJob>(job).spec, ""); }

std::string twin(const Job& job)
{
    return key_of(perfect_twin(std::get<SessionJob>(job).spec), "");
}

/// The labels of the jobs that each shard takes, part after part.
std::vector<std::vector<std::string>> dealt(const Experiment& experiment, std::uint32_t count)
{
    std::vector<std::vector<std::string>> shards(count);
    const auto parts = parts_of(experiment);
    for (std::uint32_t index = 0; index < count; ++index) {
        ShardDeal deal{{index, count}, make_jobs(parts.front())};
        for (const Experiment& part : parts) {
            for (const Job& job : make_jobs(part)) {
                if (deal.takes(job)) shards[index].push_back(label(job));
            }
        }
    }
    return shards;
}

TEST(Parts, OfAPlaneHaveItsSessionsInItsOrder)
{
    std::vector<std::string> whole, joined;
    for (const Job& job : make_jobs(plane())) whole.push_back(label(job));
    const auto parts = parts_of(plane());
    EXPECT_EQ(parts.size(), 6U);
    for (const Experiment& part : parts) {
        for (const Job& job : make_jobs(part)) joined.push_back(label(job));
    }
    EXPECT_EQ(joined, whole);
}

TEST(Shards, ShareAllJobsOutAndNoneTwice)
{
    for (const std::uint32_t count : {1U, 3U, 20U, 21U, 500U}) {
        std::multiset<std::string> all;
        std::size_t least = SIZE_MAX, most = 0;
        for (const auto& shard : dealt(plane(), count)) {
            all.insert(shard.begin(), shard.end());
            least = std::min(least, shard.size());
            most = std::max(most, shard.size());
        }
        EXPECT_EQ(all.size(), 120U) << count;
        EXPECT_EQ(std::set(all.begin(), all.end()).size(), 120U) << count;
        const std::size_t uneven = count <= 20 ? 6 : 1; // 20 twins of 6 sessions
        EXPECT_LE(most - least, uneven) << count;
    }
}

TEST(Shards, PlayATwinInOnePlaceWhereThereAreEnoughOfThem)
{
    const auto experiment = plane();
    std::set<std::string> twins;
    std::size_t played = 0;
    for (std::uint32_t index = 0; index < 7; ++index) {
        ShardDeal deal{{index, 7}, make_jobs(parts_of(experiment).front())};
        std::set<std::string> own;
        for (const Job& job : make_jobs(experiment)) {
            if (deal.takes(job)) own.insert(twin(job));
        }
        played += own.size();
        twins.insert(own.begin(), own.end());
    }
    EXPECT_EQ(twins.size(), 20U);
    EXPECT_EQ(played, 20U);
}

} // namespace
} // namespace hapnet::lab::experiment
