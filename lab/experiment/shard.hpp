// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>

namespace hapnet::lab::experiment {

/// One of `count` shares of an experiment's jobs, `index` from 0.
struct Shard {
    std::uint32_t index = 0;
    std::uint32_t count = 1;

    friend bool operator==(const Shard&, const Shard&) = default;
};

inline constexpr std::uint32_t shards_max = 100'000;

/// Reads a text such as "3/16".
[[nodiscard]] base::Result<Shard> parse_shard(std::string_view text);

/// Distributes the jobs of an experiment to its shards. The distribution is the same for all
/// callers that pass the jobs in the same order. Jobs that share a perfect twin go to the same
/// shard, which then plays the twin once. If there are fewer twins than shards, the jobs go to the
/// shards in turn.
class ShardDeal {
public:
    /// `first_jobs` are the first jobs that takes() will get. They determine how many twins there
    /// are.
    ShardDeal(const Shard& shard, const std::vector<Job>& first_jobs);

    /// True if the next job belongs to the shard.
    [[nodiscard]] bool takes(const Job& job);

private:
    /// Algorithm, task, number of peers, scene and seed. A search has all seeds.
    using Twin = std::tuple<std::size_t, device::Task, std::uint32_t, std::size_t, std::uint64_t>;
    [[nodiscard]] static Twin twin_of(const Job& job);
    [[nodiscard]] std::size_t number_of(const Twin& twin);

    Shard shard_;
    std::map<Twin, std::size_t> twins_;
    bool by_twins_ = false;
    std::size_t next_ = 0;
};

} // namespace hapnet::lab::experiment
