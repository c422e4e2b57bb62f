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

/// All emulated paths of a run, with one clock and one generation: conditions that change, by the
/// timeline or by hand, change on all paths at once. Paths may come and go. Does no I/O and reads
/// no clock.
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
        /// Names of paths that another thread has. The decisions for them count in this generation,
        /// too.
        std::vector<std::string> elsewhere{};
    };

    Paths(const Profile& profile, Setup setup);

    /// Adds a path of this name, which must not exist yet, and one path for each of its flows,
    /// which its branches() has. All have the state as if they had existed from the start. They do
    /// not move until they are removed; the flows are removed with their path.
    EmulatedPath& add(const std::string& name);
    void remove(std::string_view name);

    /// Follows the timeline of all paths up to `now`. Cheap when nothing changes.
    void advance(base::TimePoint now)
    {
        now_ = std::max(now_, now);
        if (base::is_due(next_change_, now)) advance_all(now);
    }

    /// Does the same as advance(), but also gives the time to paths where nothing changes.
    void catch_up(base::TimePoint now)
    {
        now_ = std::max(now_, now);
        advance_all(now_);
    }

    /// Returns the command for a path, by its name and the conditions that hold on it. Paths whose
    /// names are not mentioned in apply() get the same command for the same conditions.
    using CommandFor =
        std::function<base::Result<Command>(std::string_view path, const Path& conditions)>;

    /// Applies commands to all paths at once. If one path would refuse, nothing changes.
    /// `mentioned`: the names in the command. For a path that does not exist yet, the command is
    /// kept until the path is added.
    base::Result<void> apply(const CommandFor& command, std::span<const std::string> mentioned,
                             base::TimePoint now, ChangeCause by = ChangeCause::hand);

    /// Returns the generation. It is 1 at first, and grows by one whenever conditions have changed
    /// or other profiles were applied.
    [[nodiscard]] std::uint64_t generation() const { return generation_; }
    [[nodiscard]] base::Duration elapsed() const { return now_ - setup_.start; }
    /// Returns the latest time that the paths have been given.
    [[nodiscard]] base::TimePoint now() const { return now_; }

    /// Ensures that the next generation is greater than this one.
    void count_from(std::uint64_t generation) { generation_ = std::max(generation_, generation); }

    /// Returns the time when the next datagram of any path is due. It asks only the paths whose
    /// state has changed.
    [[nodiscard]] std::optional<base::TimePoint> next_due()
    {
        refresh_due_times();
        return due_times_->earliest();
    }
    /// Calls `visit(number)` with the EmulatedPath::number() of each path that has a datagram due
    /// at `now`.
    void each_due(base::TimePoint now, const auto& visit)
    {
        refresh_due_times();
        due_times_->each_due(now, visit);
    }
    [[nodiscard]] std::optional<base::TimePoint> next_change() const { return next_change_; }

    /// Returns the path with this EmulatedPath::number().
    [[nodiscard]] EmulatedPath& at(std::size_t number) const { return *by_number_[number]; }

    [[nodiscard]] PathNames names() const;
    /// Returns the flows of each path.
    [[nodiscard]] const std::vector<Flow>& flows() const { return profile_.flows; }

    struct Named {
        std::string name;
        std::unique_ptr<EmulatedPath> path;
    };
    /// Returns the paths in the order in which they were added, each followed by its flows.
    [[nodiscard]] const std::vector<Named>& all() const { return paths_; }

    /// The director of a path. Paths that do not exist are included if a director is kept for them.
    struct Decider {
        /// The name of the path. If it is empty, or that of a flow without a path, this director is
        /// for all future paths that have no settings of their own.
        std::string_view name;
        const Director* director = nullptr;
    };
    [[nodiscard]] std::vector<Decider> deciders() const;

    /// The greatest number of names for which a run with newcomers can keep settings.
    static constexpr std::size_t absent_max = 64;

private:
    /// The director of paths that do not exist here.
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
    /// Returns a director for a path with the state as if it had existed from the start and nothing
    /// had been changed.
    [[nodiscard]] Director beginning_of(const std::string& name) const;
    void keep_for_absent(const std::string& name);
    [[nodiscard]] std::uint64_t generations() const;

    Profile profile_;
    Setup setup_;
    std::shared_ptr<const FlowFilters> filters_; // null: there are no flows
    /// Directors in their initial state, for paths that the profile does not name: one for each
    /// flow and, last, one for the other traffic, by common_name().
    std::vector<Absent> beginnings_;
    std::vector<std::string> said_of_; // paths that the profile names
    /// The current directors for future paths of clients, by common_name(). Empty in a run without
    /// newcomers.
    std::vector<Absent> newcomers_;
    // Directors of named paths that do not exist or are in another part
    std::vector<Absent> absent_;
    std::vector<std::string> mentioned_; // names of clients' paths that have settings of their own
    std::unique_ptr<DueTimes> due_times_ = std::make_unique<DueTimes>(); // marked by the paths
    std::vector<EmulatedPath*> by_number_; // null: no path has this number
    std::vector<Named> paths_;
    base::TimePoint now_;
    std::uint64_t generation_ = 1;
    std::optional<base::TimePoint> next_change_;
};

} // namespace hapnet::emulator
