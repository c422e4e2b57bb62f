// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"

#include <vector>

namespace hapnet::emulator {

/// The paths of a run whose parts relay side by side: each part has Paths of its own, which know of
/// the paths of the others what is decided for them, and so decide the same. What one is told, all
/// are told. Its functions are for a moment in which no part is at work.
class AllPaths {
public:
    /// Of a run with one part. Implicit: it is what most runs have.
    AllPaths(Paths& only) : parts_{&only} {} // NOLINT(google-explicit-constructor)
    /// At least one.
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
    /// The latest time that one of them has been told.
    [[nodiscard]] base::TimePoint latest_now() const;
    [[nodiscard]] std::optional<base::TimePoint> next_change() const;
    [[nodiscard]] PathNames names() const { return parts_.front()->names(); }
    [[nodiscard]] const std::vector<Flow>& flows() const { return parts_.front()->flows(); }

    /// Those that are there, in each part in the order in which they came.
    [[nodiscard]] std::vector<const Paths::Named*> all() const;

    /// What decides for each; see Paths::deciders().
    [[nodiscard]] std::vector<Paths::Decider> deciders() const;

private:
    std::vector<Paths*> parts_;
};

} // namespace hapnet::emulator
