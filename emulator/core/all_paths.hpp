// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"

#include <vector>

namespace hapnet::emulator {

/// The paths of a run whose parts relay concurrently. Each part has Paths of its own, which also
/// know the decisions for the paths of the other parts, so that all parts decide the same.
/// Each command goes to all parts. Call the functions of this class only while no part is at work.
class AllPaths {
public:
    /// All paths of a run with one part. Implicit: most runs have one part.
    AllPaths(Paths& only) : parts_{&only} {} // NOLINT(google-explicit-constructor)
    /// `parts` has at least one part.
    explicit AllPaths(std::vector<Paths*> parts);

    /// Applies a command to all parts or to none; see Paths::apply().
    base::Result<void> apply(const Paths::CommandFor& command,
                             std::span<const std::string> mentioned, base::TimePoint now,
                             ChangeCause by = ChangeCause::hand);

    /// See Paths::catch_up().
    void catch_up(base::TimePoint now);

    /// Returns the generation, which grows with that of each part.
    [[nodiscard]] std::uint64_t generation() const;
    [[nodiscard]] base::Duration elapsed() const;
    /// Returns the latest time that any part has been given.
    [[nodiscard]] base::TimePoint latest_now() const;
    [[nodiscard]] std::optional<base::TimePoint> next_change() const;
    [[nodiscard]] PathNames names() const { return parts_.front()->names(); }
    [[nodiscard]] const std::vector<Flow>& flows() const { return parts_.front()->flows(); }

    /// Returns the existing paths, part by part, in the order in which they were added.
    [[nodiscard]] std::vector<const Paths::Named*> all() const;

    /// Returns the directors of all paths; see Paths::deciders().
    [[nodiscard]] std::vector<Paths::Decider> deciders() const;

private:
    std::vector<Paths*> parts_;
};

} // namespace hapnet::emulator
