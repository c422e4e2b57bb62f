// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/director.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace hapnet::emulator {

/// The numbers of the next datagrams to arrive.
struct NextNumbers {
    std::uint64_t up = 0;
    std::uint64_t down = 0;
};

/// The running emulator as its control sees it. All functions are called from the thread that
/// relays, between two datagrams.
struct Emulation {
    Director& director;
    /// Hands changed conditions to both links.
    std::function<void(const Path& path, base::TimePoint now)> enact;
    std::function<NextNumbers()> next_numbers;
    /// The statistics as one JSON object.
    std::function<std::string()> statistics_json;
    /// The text of a file that a profile or a setting names; `beside` is the file of the profile,
    /// empty for a setting.
    std::function<base::Result<std::string>(const std::string& name, const std::string& beside)>
        open;
};

} // namespace hapnet::emulator
