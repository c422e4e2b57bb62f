// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace hapnet::net {

/// The largest number of descriptors that wait_readable() accepts.
inline constexpr std::size_t descriptors_max = 32;

/// Sleeps until one of the descriptors is readable or `deadline` has come, whichever is first.
/// nullopt: waits for the descriptors only. A signal may end the wait early. Returns true if a
/// descriptor is readable.
bool wait_readable(std::span<const int> descriptors, std::optional<base::TimePoint> deadline);

} // namespace hapnet::net
