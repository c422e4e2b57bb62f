// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/record/rows.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hapnet::record {

/// Fills the fields of a row with whatever bits a row may hold; draws in a fixed order from one
/// stream.
class RandomFields {
public:
    RandomFields(base::RandomStream stream, std::uint64_t round) : stream_{stream}, round_{round} {}

    void operator()(std::string_view, bool& value) { value = (bits() & 1) != 0; }
    void operator()(std::string_view, Phase& value)
    {
        value = static_cast<Phase>(bits() % base::names_of_enum<Phase>.size());
    }
    void operator()(std::string_view, std::uint8_t& value)
    {
        value = static_cast<std::uint8_t>(bits());
    }
    void operator()(std::string_view, std::uint16_t& value)
    {
        value = static_cast<std::uint16_t>(bits());
    }
    void operator()(std::string_view, std::uint32_t& value)
    {
        value = static_cast<std::uint32_t>(bits());
    }
    void operator()(std::string_view, std::uint64_t& value) { value = bits(); }
    void operator()(std::string_view, base::Duration& value)
    {
        value = base::Duration{signed_bits()};
    }
    void operator()(std::string_view, base::TimePoint& value)
    {
        value = base::TimePoint{base::Duration{signed_bits()}};
    }
    void operator()(std::string_view, double& value) { value = finite_bits(); }
    void operator()(std::string_view, std::vector<std::byte>& value)
    {
        value.resize(bits() % (MessageRow::bytes_max + 1));
        for (std::byte& b : value) b = static_cast<std::byte>(bits() & 0xff);
    }
    void operator()(std::string_view, glm::dquat& value)
    {
        for (glm::length_t i = 0; i < 4; ++i) value[i] = finite_bits();
    }
    // Any finite double. Others equal nothing, so they could not be compared.
    void operator()(std::string_view, auto& vector)
    {
        for (glm::length_t i = 0; i < 3; ++i) vector.value[i] = finite_bits();
    }

private:
    std::uint64_t bits() { return stream_.bits(round_, draw_++); }
    double finite_bits()
    {
        const auto value = std::bit_cast<double>(bits());
        return std::isfinite(value) ? value : 0.0;
    }
    // Within the range of a row: 2^60 ns either way.
    std::int64_t signed_bits() { return static_cast<std::int64_t>(bits()) >> 3; }

    base::RandomStream stream_;
    std::uint64_t round_;
    std::uint32_t draw_ = 0;
};

} // namespace hapnet::record
