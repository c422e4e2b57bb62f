// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"
#include "proto/net/address_set.hpp"
#include "proto/net/endpoint.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string_view>

/// Durations and shares that are accepted are in range, and print as text that parses to the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    if (const auto duration = base::parse_duration(text)) {
        base::ensure(duration->count() >= 0);
        base::ensure(base::parse_duration(base::to_text(*duration)).value() == *duration);
    }
    if (const auto share = base::parse_probability(text)) {
        base::ensure(share->fraction() >= 0.0 && share->fraction() <= 1.0);
        base::ensure(base::parse_probability(base::to_text(*share)).value() == *share);
    }
    std::ignore = net::parse_host_port(text);
    if (const auto pattern = net::parse_address_pattern(text)) {
        base::ensure(!pattern->host.empty() && pattern->prefix.value_or(0) <= 128);
        net::AddressSet set; // of a network, which needs no look-up of names
        if (pattern->prefix) base::ensure(set.add(*pattern).has_value() != set.empty());
    }
    return 0;
}
