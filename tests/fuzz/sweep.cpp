// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/sweep.hpp"

#include "tests/fuzz/fuzz_target.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

/// Any results of a session in a sweep are read or refused. Results that were read are written as
/// text that reads back as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const auto json = nlohmann::json::parse(std::span{data, size}, nullptr, false);
    if (!json.is_object()) return 0;
    const auto read = lab::results::played_cell_from(json);
    if (!read) return 0;
    const auto written = lab::results::to_json(*read).dump();
    const auto again = lab::results::played_cell_from(nlohmann::json::parse(written));
    base::ensure(again.has_value() && lab::results::to_json(*again).dump() == written);
    return 0;
}
