// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/replay/hand_trace.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::lab::hands {

/// The intended motions of two hands in a session, from the recording of one or two people.
struct Trial {
    std::string subject;
    std::string name;
    /// The motions of A and of B; empty: the simulated hand follows the task.
    std::array<std::shared_ptr<const device::HandTrace>, 2> ways{};

    /// Returns the end of the motion that ends last, seconds.
    [[nodiscard]] double end_s() const;
};

/// Recorded hands of several people: a folder that `hapnet-lab import hands` wrote.
struct Population {
    std::string folder; // path of the folder, as it was given
    std::vector<Trial> trials;

    [[nodiscard]] std::size_t subjects() const;
    /// Returns the last part of the path: "people" for "recordings/people/".
    [[nodiscard]] std::string name() const;
};

/// Reads the manifest of a folder and the scripts that it names. The error names the file.
[[nodiscard]] base::Result<Population> read_population(const std::string& folder,
                                                       const base::Reading& reading);

} // namespace hapnet::lab::hands
