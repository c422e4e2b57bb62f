// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::scene {

/// A face, edge or corner of a box: one bit for each of the (one, two or three) faces that meet
/// there. What two features have in common is their `and`; where both hold, their `or`.
using FeatureBits = std::uint32_t;

inline constexpr std::uint32_t feature_bits_count = 6;

/// The face of an axis, 0..2, on its positive or negative side.
[[nodiscard]] constexpr FeatureBits face_bit(int axis, bool is_positive)
{
    return 1U << (2U * static_cast<unsigned>(axis) + (is_positive ? 1U : 0U));
}

/// Which features of two boxes meet: as ContactPoint::feature holds it.
[[nodiscard]] constexpr std::uint32_t feature_pair(FeatureBits first, FeatureBits second)
{
    return first | second << feature_bits_count;
}

/// The same meeting with the boxes exchanged.
[[nodiscard]] constexpr std::uint32_t swapped_feature_pair(std::uint32_t feature)
{
    constexpr std::uint32_t mask = (1U << feature_bits_count) - 1U;
    return feature_pair(feature >> feature_bits_count, feature & mask);
}

} // namespace hapnet::scene
