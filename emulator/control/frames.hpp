// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/all_paths.hpp"
#include "emulator/core/pulse.hpp"
#include "emulator/core/statistics.hpp"
#include "proto/control/core/conversation.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// Makes frames for those who watch: docs/formats/live.md. What has left the links is shared out to
/// all watches whenever one of them asks, so that none misses what another has seen.
class Frames : public std::enable_shared_from_this<Frames> {
public:
    /// A frame has at most so many paths.
    static constexpr std::size_t paths_max = 32;

    /// Begins a watch; it ends when the source is destroyed, and `paths` outlive it. For a moment
    /// in which nothing is relayed, like the source itself.
    [[nodiscard]] control::FrameSource watch(AllPaths& paths);

private:
    /// One direction of a path, as a watch sees it.
    struct Way {
        Pulse pulse;                // since its last frame
        std::uint64_t received = 0; // as they were at its last frame
        std::uint64_t delivered = 0;
        std::uint64_t duplicated = 0;
        std::array<std::uint64_t, drop_causes.size()> dropped{};
    };
    using Ways = std::array<Way, 2>; // up, down
    struct Watch {
        std::uint64_t frames = 0;
        std::map<std::string, Ways, std::less<>> paths;
    };

    void share_out(AllPaths& paths);
    static void begin(Way& way, const Statistics& statistics);
    static void write(std::string& text, Way& way, const Statistics& statistics);
    static void write(std::string& text, Watch& watch, AllPaths& paths, std::uint64_t left_out);

    std::vector<std::weak_ptr<Watch>> watches_;
};

} // namespace hapnet::emulator
