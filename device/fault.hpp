// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace hapnet::device {

/// What can be wrong with a device: a closed set, to which every backend maps what its library,
/// the kernel or the device itself says.
enum class Fault : std::uint8_t {
    none,
    not_found,
    permission,       // the system refuses access
    in_use,           // another program has it
    firmware_missing, // it runs only on firmware that a user has to supply
    library_missing,  // its vendor's library
    communication,    // it says what makes no sense, or its library reports an error of the line
    timeout,          // it answers no more
    overheat,
    over_force,
    over_velocity,
    not_calibrated, // it lost its calibration
    disconnected,
    internal, // of a library, or of this program
};

/// Such as "over-velocity": in statistics.
[[nodiscard]] std::string_view name_of(Fault fault);
/// What it means and what to do about it, for a person: one sentence or two. "" for none.
[[nodiscard]] std::string_view words_for(Fault fault);

/// Why a device cannot be used.
struct Trouble {
    Fault fault = Fault::internal;
    std::string message;   // what happened, and the cure
    std::int64_t code = 0; // the library's or the kernel's own number for it; 0: none
};

/// A value, or why there is none.
template <typename T>
using Opened = tl::expected<T, Trouble>;

/// The failing side of an Opened.
[[nodiscard]] inline tl::unexpected<Trouble> trouble(Fault fault, std::string message,
                                                     std::int64_t code = 0)
{
    return tl::unexpected<Trouble>{Trouble{fault, std::move(message), code}};
}

} // namespace hapnet::device
