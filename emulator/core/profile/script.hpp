// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/timeline.hpp"

#include <cstddef>

namespace hapnet::emulator {

/// An immutable profile with its timeline. Directors share it, so that they can follow another one
/// at the same cost whatever its length.
class Script {
public:
    /// Ensures that the profile is valid. Takes time: some 10 us, and 1 us for each change.
    explicit Script(Profile profile);

    [[nodiscard]] const Profile& profile() const { return profile_; }
    [[nodiscard]] const Timeline& timeline() const { return timeline_; }

    /// True if both have the same text apart from the seed. The comparison is by hashes: two
    /// different ones compare as equal once in 2^64 pairs.
    [[nodiscard]] bool says_the_same_as(const Script& other) const { return hash_ == other.hash_; }

private:
    Profile profile_;
    Timeline timeline_;
    std::size_t hash_; // hash of the profile's text without the seed
};

} // namespace hapnet::emulator
