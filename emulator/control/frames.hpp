// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/frame_report.hpp"
#include "emulator/core/all_paths.hpp"
#include "emulator/core/pulse.hpp"
#include "emulator/core/statistics.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/control/core/work.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// Makes frames for watches: docs/formats/live.md. Whenever one watch asks for a frame, the
/// departures from the links are distributed to all watches, so that each watch sees every
/// departure.
class Frames : public std::enable_shared_from_this<Frames> {
public:
    /// Largest number of paths in a frame.
    static constexpr std::size_t paths_max = 32;

    /// Begins a watch, which ends when the returned source is destroyed. `paths` must outlive the
    /// source. Only steps of `work` read the paths.
    [[nodiscard]] control::FrameSource watch(AllPaths& paths, const control::DoWork& work);

private:
    /// One direction of a path at one look.
    struct Seen {
        Pulse pulse; // traffic since the previous look
        Counters counters;
    };
    struct SeenPath {
        std::string name;
        std::array<Seen, 2> ways; // up, down
    };
    struct Look {
        base::TimePoint at{};
        base::Duration elapsed{};
        std::uint64_t generation = 0;
        std::size_t all_paths = 0;
        std::vector<SeenPath> paths; // at most as many as a frame has room for
    };

    /// One direction of a path, as a watch sees it.
    struct Way {
        Pulse pulse;       // traffic since the watch's last frame
        Counters counters; // values at the watch's last frame
    };
    using Ways = std::array<Way, 2>;
    struct Watch {
        std::uint64_t frames = 0;
        std::map<std::string, Ways, std::less<>> paths;
    };

    [[nodiscard]] static Look look(AllPaths& paths);
    /// Takes a look, and adds the departures from the links to every watch.
    [[nodiscard]] Look share_out(AllPaths& paths, const control::DoWork& work);
    /// Returns the figures of one direction since its last frame. The next figures count from this
    /// call.
    [[nodiscard]] static WayFrame frame_of(Way& way, const Seen& seen);
    static void write(std::string& text, Watch& watch, const Look& look, std::uint64_t left_out);

    std::vector<std::weak_ptr<Watch>> watches_;
};

} // namespace hapnet::emulator
