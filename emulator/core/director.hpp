// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/script.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// Sets settings from now on, which override those of the profile. With `lasting` they end after
/// that time, and the conditions return to those without these settings.
struct Set {
    Patch up;
    Patch down;
    std::optional<base::Duration> lasting{}; // > 0; nullopt: for good
};

/// Applies another profile. Its timeline counts from now, and settings made by hand are gone.
struct Apply {
    std::shared_ptr<const Script> script; // never null

    explicit Apply(std::shared_ptr<const Script> other) : script{std::move(other)} {}
    explicit Apply(Profile profile) : script{std::make_shared<const Script>(std::move(profile))} {}
};

/// Returns to the profile with which the emulator was started, at the present time of its timeline,
/// as if no change had been made.
struct Reset {};

using Command = std::variant<Set, Apply, Reset>;

/// Decides which conditions are in effect at each time, from a profile, its timeline, and settings
/// made by hand. The later of two changes of the same setting wins, no matter whether a step of the
/// timeline or a person made it: a setting made by hand lasts until the timeline's next step of
/// that setting. A ramp that is in progress at that moment has no effect on the setting.
///
/// Does no I/O and reads no clock: feed it with apply(), call advance() by next_change(), and hand
/// path() to the links whenever generation() has grown.
class Director {
public:
    /// The greatest number of settings made by hand at one time. Settings that can never take
    /// effect again do not count.
    static constexpr std::size_t overrides_max = 64;

    /// Settings made by hand that no later change has replaced.
    struct Override {
        Patch up;
        Patch down;
        std::optional<base::TimePoint> until; // nullopt: for good

        friend bool operator==(const Override&, const Override&) = default;
    };

    /// The profile's timeline counts from `start`. The director keeps the seed of this profile,
    /// that of the run.
    Director(Profile profile, base::TimePoint start);
    Director(std::shared_ptr<const Script> script, base::TimePoint start);

    // Both are defined in director.cpp, so that files that use a Director do not compile them.
    ~Director();
    Director(Director&&) noexcept;
    Director& operator=(Director&&) noexcept;
    Director(const Director&);
    Director& operator=(const Director&);

    /// Returns the conditions in effect at the time of the last call.
    [[nodiscard]] const Path& path() const { return *path_; }
    /// Returns the conditions of path() for sharing with the links. Never null.
    [[nodiscard]] const std::shared_ptr<const Path>& shared_path() const { return path_; }

    /// Returns the generation. It is 1 at first, and grows by one whenever path() has changed or
    /// another profile was applied.
    [[nodiscard]] std::uint64_t generation() const { return generation_; }

    /// The cause of the last change of path(): a setting made by hand or its end, a step of the
    /// timeline, or a step of a ramp. Steps of a ramp follow each other by the millisecond.
    enum class Reason : std::uint8_t { hand, step, ramp };
    [[nodiscard]] Reason last_reason() const { return last_reason_; }

    /// Returns the time at which to call advance() again; nullopt when the passage of time changes
    /// nothing.
    [[nodiscard]] std::optional<base::TimePoint> next_change() const { return next_change_; }

    /// Moves on to `now`. Returns true if the conditions have changed. Cheap before next_change().
    bool advance(base::TimePoint now)
    {
        const base::TimePoint before = now_;
        now_ = std::max(now, now_);
        return base::is_due(next_change_, now_) && change_after(before);
    }

    /// Carries out the command at once. A refused command changes nothing. Apply and Reset are
    /// never refused.
    base::Result<void> apply(const Command& command, base::TimePoint now);

    /// True if a quick check finds both directors in the same state. A command that both receive
    /// then has the same effect on both, so that it has to be carried out only once. Their times
    /// may differ while nothing has become due.
    [[nodiscard]] bool is_twin_of(const Director& other) const;

    /// Returns the profile that the director follows, with the timeline.
    [[nodiscard]] const Script& script() const { return *script_; }

    /// The settings made by hand. A later one wins over an earlier one. Never null.
    using Overrides = std::vector<std::shared_ptr<const Override>>;
    [[nodiscard]] const Overrides& overrides() const { return overrides_; }

    /// Returns the time of the last call.
    [[nodiscard]] base::TimePoint now() const { return now_; }

    /// Returns the time since the timeline began.
    [[nodiscard]] base::Duration position() const { return now_ - begin_; }

    /// Returns the time since the run began.
    [[nodiscard]] base::Duration elapsed() const { return now_ - start_; }

    /// Returns a profile that changes nothing when it is applied now: the current conditions and
    /// the rest of the timeline. It does not include the ends of settings made for a limited time.
    [[nodiscard]] Profile remaining() const;

private:
    [[nodiscard]] base::Result<Overrides> overrides_with(const Set& set) const;
    void follow(std::shared_ptr<const Script> script, base::TimePoint begin);
    bool change_after(base::TimePoint before);
    bool let_later_steps_win(base::Duration before);
    bool update();
    [[nodiscard]] std::optional<base::TimePoint> find_next_change() const;

    std::shared_ptr<const Script> started_with_;
    base::TimePoint start_;
    std::shared_ptr<const Script> script_;
    base::TimePoint begin_; // time 0 of the timeline
    base::TimePoint now_;
    Overrides overrides_;
    std::shared_ptr<const Path> path_;
    std::uint64_t generation_ = 1;
    Reason last_reason_ = Reason::hand;
    std::optional<base::TimePoint> next_change_;
};

} // namespace hapnet::emulator
