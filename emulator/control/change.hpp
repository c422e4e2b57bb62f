// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/core/change_log.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/core/profile/script.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The scripts that the paths of a run follow once a profile is applied: one for each path with
/// settings of its own, and one that all other paths share.
class Scripts {
public:
    explicit Scripts(const Profile& profile);

    /// Returns the script of a path. Paths without settings of their own share one.
    [[nodiscard]] const std::shared_ptr<const Script>& of(std::string_view path) const;
    /// The names of the paths with settings of their own.
    [[nodiscard]] const std::vector<std::string>& mentioned() const { return mentioned_; }

    /// Returns the command that makes each path follow its script. The scripts must outlive the
    /// command.
    [[nodiscard]] Paths::CommandFor command() const;

private:
    std::shared_ptr<const Script> usual_;
    std::map<std::string, std::shared_ptr<const Script>, std::less<>> own_;
    std::vector<std::string> mentioned_;
};

/// The numbers of the next datagrams of a path.
struct NextNumbers {
    std::string name;
    std::uint64_t up = 0;
    std::uint64_t down = 0;
};

/// The outcome of a command.
struct Effect {
    std::uint64_t generation = 0;
    bool has_changed = false;
    base::TimePoint at{}; // time from which the command is in effect
    base::Duration elapsed{};
    std::vector<NextNumbers> next; // the first datagrams of each path that it affects
};

/// Applies the command to all paths at once, in one step of the emulation's work; see
/// Paths::apply(). The calling thread frees the replaced settings.
[[nodiscard]] base::Result<Effect> change(Emulation& emulation, const Paths::CommandFor& command,
                                          std::span<const std::string> mentioned,
                                          base::TimePoint now, ChangeCause by = ChangeCause::hand);

} // namespace hapnet::emulator
