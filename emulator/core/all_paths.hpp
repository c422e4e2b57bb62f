// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"

#include <vector>

namespace hapnet::emulator {

/// The paths of a run whose parts relay side by side: each part has Paths of its own, which know
/// the decisions for the paths of the other parts, and so decide the same. Each command goes to all
/// parts. Call its functions only while no part is at work.
class AllPaths {
public:
    /// All paths of a run with one part. Implicit: most runs have one part.
    AllPaths(Paths& only) : parts_{&only} {} // NOLINT(google-explicit-constructor)
    /// `parts` has at least one part.
    explicit AllPaths(std::vector<Paths*> parts);

    /// See Paths::apply(): for all parts, or for none.
    base::Result<void> apply(const Paths::CommandFor& command,
                             std::span<const std::string> mentioned, base::TimePoint now,
                             ChangeCause by = ChangeCause::hand);

    /// See Paths::catch_up().
    void catch_up(base::TimePoint now);

    /// Grows as that of each part does.
    [[nodiscard]] std::uint64_t generation() const;
    [[nodiscard]] base::Duration elapsed() const;
    /// The latest time that any part has been given.
    [[nodiscard]] base::TimePoint latest_now() const;
    [[nodiscard]] std::optional<base::TimePoint> next_change() const;
    [[nodiscard]] PathNames names() const { return parts_.front()->names(); }
    [[nodiscard]] const std::vector<Flow>& flows() const { return parts_.front()->flows(); }

    /// The paths that are there, part by part, in the order in which they came.
    [[nodiscard]] std::vector<const Paths::Named*> all() const;

    /// The directors of all paths; see Paths::deciders().
    [[nodiscard]] std::vector<Paths::Decider> deciders() const;

private:
    std::vector<Paths*> parts_;
};

} // namespace hapnet::emulator
