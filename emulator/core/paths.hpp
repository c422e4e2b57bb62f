// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/due_times.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// All emulated paths of a run, on one clock and with one generation: conditions that change, by
/// the timeline or by hand, change on all paths at once. Paths may come and go. Does no I/O and
/// reads no clock.
class Paths {
public:
    struct Setup {
        base::Seed seed{1};
        base::TimePoint start{};
        QueueLimits limits{};                         // limits for each direction of each path
        std::shared_ptr<Slab> slab{};                 // all paths share it; null: each has its own
        std::shared_ptr<const FatesOfPaths> replay{}; // null: fates are drawn
        bool takes_newcomers = false;                 // paths of clients come and go during the run
        StreamDetail stream_detail = StreamDetail::totals;
        std::size_t changes_max = ChangeLog::entries_max; // changes that each path keeps
        /// Names of paths that another thread has: what is decided for them counts here, too.
        std::vector<std::string> elsewhere{};
    };

    Paths(const Profile& profile, Setup setup);

    /// A path of this name, which is not there yet, and one for each flow on it, which its
    /// branches() have: as if they had been from the start. They stay where they are until they
    /// are removed, with it.
    EmulatedPath& add(const std::string& name);
    void remove(std::string_view name);

    /// Follows the timeline up to `now`, with all paths. Cheap when nothing changes.
    void advance(base::TimePoint now)
    {
        now_ = std::max(now_, now);
        if (base::is_due(next_change_, now)) advance_all(now);
    }

    /// Like advance(), but gives all paths the time, also where nothing changes.
    void catch_up(base::TimePoint now)
    {
        now_ = std::max(now_, now);
        advance_all(now_);
    }

    /// Returns the command for a path, by its name and the conditions that hold on it. Paths whose
    /// names are not mentioned in apply() get the same command for the same conditions.
    using CommandFor =
        std::function<base::Result<Command>(std::string_view path, const Path& conditions)>;

    /// Applies commands to all paths at once. Nothing changes when one path would refuse.
    /// `mentioned`: the names in the command. For a path that does not exist yet, the command is
    /// kept until it appears.
    base::Result<void> apply(const CommandFor& command, std::span<const std::string> mentioned,
                             base::TimePoint now, ChangeCause by = ChangeCause::hand);

    /// 1 at first, and one more whenever conditions have changed or other profiles were applied.
    [[nodiscard]] std::uint64_t generation() const { return generation_; }
    [[nodiscard]] base::Duration elapsed() const { return now_ - setup_.start; }
    /// The latest time that the paths have been given.
    [[nodiscard]] base::TimePoint now() const { return now_; }

    /// The next generation comes after this one.
    void count_from(std::uint64_t generation) { generation_ = std::max(generation_, generation); }

    /// The time when the next datagram of any path is due. It asks only paths whose state has
    /// changed.
    [[nodiscard]] std::optional<base::TimePoint> next_due()
    {
        refresh_due_times();
        return due_times_->earliest();
    }
    /// `visit(number)` for the EmulatedPath::number() of each that has a datagram due at `now`.
    void each_due(base::TimePoint now, const auto& visit)
    {
        refresh_due_times();
        due_times_->each_due(now, visit);
    }
    [[nodiscard]] std::optional<base::TimePoint> next_change() const { return next_change_; }

    /// The path with this EmulatedPath::number().
    [[nodiscard]] EmulatedPath& at(std::size_t number) const { return *by_number_[number]; }

    [[nodiscard]] PathNames names() const;
    /// The flows of each path.
    [[nodiscard]] const std::vector<Flow>& flows() const { return profile_.flows; }

    struct Named {
        std::string name;
        std::unique_ptr<EmulatedPath> path;
    };
    /// The paths in the order in which they came, each with its flows behind it.
    [[nodiscard]] const std::vector<Named>& all() const { return paths_; }

    /// The director of a path. Paths that are not there are included as far as something is known
    /// of them.
    struct Decider {
        /// Empty, or a flow without a path: this director is for all paths to come that have no
        /// settings of their own.
        std::string_view name;
        const Director* director = nullptr;
    };
    [[nodiscard]] std::vector<Decider> deciders() const;

    /// The number of names for which a run with newcomers can keep settings.
    static constexpr std::size_t absent_max = 64;

private:
    /// The director of paths that are not there.
    struct Absent {
        std::string name;
        Director director;
    };

    class Twins;

    EmulatedPath& add_one(const std::string& name);
    void remove_one(std::string_view name);
    void advance_all(base::TimePoint now);
    void refresh_due_times()
    {
        due_times_->refresh([this](std::size_t number) { return by_number_[number]->next_due(); });
    }
    void find_next_change();
    base::Result<void> expect(std::span<const std::string> mentioned);
    void forget_absent(const Command& command, std::span<const std::string> mentioned);
    [[nodiscard]] Director director_for(const std::string& name);
    /// A director for a path as if it had been there from the start, and nothing had been changed.
    [[nodiscard]] Director beginning_of(const std::string& name) const;
    void keep_for_absent(const std::string& name);
    [[nodiscard]] std::uint64_t generations() const;

    Profile profile_;
    Setup setup_;
    std::shared_ptr<const FlowFilters> filters_; // null: there are no flows
    /// Directors as at the start, for paths that the profile does not name: one for each flow and,
    /// last, one for the rest, by common_name().
    std::vector<Absent> beginnings_;
    std::vector<std::string> said_of_; // paths that the profile names
    /// The present directors for paths of clients to come, by common_name(); empty if none come.
    std::vector<Absent> newcomers_;
    std::vector<Absent> absent_; // directors of named paths that are not there, or in another part
    std::vector<std::string> mentioned_; // names of clients' paths that have settings of their own
    std::unique_ptr<DueTimes> due_times_ = std::make_unique<DueTimes>(); // marked by the paths
    std::vector<EmulatedPath*> by_number_; // null: no path has this number
    std::vector<Named> paths_;
    base::TimePoint now_;
    std::uint64_t generation_ = 1;
    std::optional<base::TimePoint> next_change_;
};

} // namespace hapnet::emulator
