// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::peer::doctor {

enum class Level : std::uint8_t {
    ok,
    warning, // it works, but not as well as it could
    bad,     // something that exists cannot be used
};
constexpr auto names_of(base::Tag<Level>) { return base::names("ok", "warn", "bad"); }

/// The result of one check.
struct Finding {
    std::string subject;
    Level level = Level::ok;
    std::string text;
    std::optional<std::string> cure{}; // one line; nullopt if all is well
};
constexpr auto fields_of(base::Tag<Finding>)
{
    return base::fields(
        "finding",
        base::member("fix", &Finding::cure, "A command or step that would mend it, in one line."),
        base::member("level", &Finding::level,
                     "ok; warn: it works, but worse than it could; bad: it cannot be used."),
        base::member("subject", &Finding::subject, "What was looked at."),
        base::member("text", &Finding::text, "What was found, in a sentence."));
}

/// The timing that the kernel grants to a loop at 1 kHz.
struct Timing {
    bool fifo = false;
    bool locked_memory = false;
    bool is_root = false;      // if true, only the outside can grant missing rights
    base::Duration slack{};    // slack of the thread's timers
    base::Duration late_p99{}; // p99 lateness of wake-ups at 1 kHz
};

/// A node of a device that hapnet knows.
struct Node {
    std::string device; // such as "Novint Falcon"
    std::string path;   // such as /dev/bus/usb/001/002
    bool is_accessible = false;
    std::string rule{}; // udev rule that the node needs; "": hapnet's rules cover it
};

/// A key file that the user asked to check.
struct KeyFact {
    std::string path;
    std::string trouble{}; // why a session would refuse the file, with the cure; "": it is fine
};

/// The facts about the system that the checks use.
struct Facts {
    Timing timing;
    std::vector<std::string> cpu_governors; // distinct ones; empty: there is no frequency scaling
    std::optional<std::uint64_t> receive_buffer_max_bytes;
    bool forces_buffers = false; // may exceed receive_buffer_max_bytes
    bool has_udev = false;
    std::optional<std::string> installed_rules; // their text; nullopt: not installed
    std::vector<Node> nodes;
    bool has_firewire_card = false;
    bool has_firewire_driver = false;
    std::string hd_trouble;  // why libHD cannot be loaded; "": it can, or is not needed
    bool hd_wanted = false;  // --hd-library is given, or a device that needs libHD exists
    bool is_date_set = true; // the wall clock is after the start of 2026
    std::optional<KeyFact> key;
};

/// Returns the findings for these facts.
[[nodiscard]] std::vector<Finding> judge(const Facts& facts);

/// Returns the udev rules of this version.
[[nodiscard]] std::string_view udev_rules();
/// Returns a one-line command that installs the udev rules, wherever the program is.
[[nodiscard]] std::string_view udev_cure();

} // namespace hapnet::peer::doctor
