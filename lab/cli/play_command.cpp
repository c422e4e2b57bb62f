// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/play_command.hpp"

#include "emulator/control/request.hpp"
#include "emulator/core/profile/text.hpp"
#include "lab/cli/files.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/experiment/text.hpp"
#include "lab/live/control.hpp"
#include "lab/presets.hpp"
#include "lab/virtual_time/play.hpp"
#include "proto/base/built_in.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/text.hpp"
#include "proto/control/server.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/text_file.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

using namespace std::chrono_literals;

/// The interval of the turns. Virtual time stands still between turns while clients are served, so
/// all their frames are of the same time.
constexpr base::Duration turn = 16ms;
/// The longest time that a turn takes when it plays as fast as possible.
constexpr base::Duration playing_max = 12ms;
/// The virtual time that such a turn plays between two checks of the clock.
constexpr base::Duration played_at_once = 20ms;
constexpr control::Server::Limits limits{.line_bytes = emulator::request_bytes_max, .answers = 8};

base::Result<std::string> preset_text(const std::string& name)
{
    for (const Preset& preset : presets_of_lab()) {
        if (preset.name == name) return std::string{preset.text};
    }
    return base::fail(fmt::format("there is no profile called '{}'", name));
}

base::Result<emulator::Profile> profile_named(const std::string& name)
{
    const auto found = base::find_text(name, presets_of_lab(), "a profile", net::text_of_file);
    if (!found) return tl::unexpected{found.error()};
    return emulator::parse_profile(found->text, found->source, net::text_of_file);
}

/// Returns the options as an experiment of one session.
base::Result<experiment::Experiment> experiment_of(const PlayCommand& command)
{
    const experiment::Overrides overrides{.settings = command.settings};
    if (!command.experiment.empty()) {
        return experiment::load_experiment(command.experiment, net::text_of_file, overrides);
    }
    std::vector<std::string> algorithms;
    for (const std::string& name : command.algorithms) algorithms.push_back(base::quoted(name));
    std::string text =
        fmt::format("kind = \"limits\"\nseeds = 1\nfirst_seed = {}\nduration = \"{}\"\n"
                    "tasks = [\"{}\"]\npeers = {}\nalgorithms = [{}]\nlimit.delay = "
                    "{{ to = \"40ms\", step = \"40ms\", resolution = \"5ms\" }}\n",
                    command.seed, base::to_text(command.duration), command.task, command.peers,
                    fmt::join(algorithms, ", "));
    if (!command.profile.empty()) {
        auto profile = profile_named(command.profile);
        if (!profile) return tl::unexpected{profile.error()};
        profile->name.clear();
        profile->seed.reset();
        profile->checks.clear();
        text += emulator::to_text(*profile);
    }
    return experiment::parse_experiment(text, "play", overrides, net::text_of_file);
}

/// Plays to the end, as `hapnet-lab run` does.
base::Result<int> play_out(const PlayCommand& command, live::Session& session,
                           const experiment::Experiment& experiment)
{
    while (!session.is_over()) session.play_on(1s);
    PlayReport report{.task = experiment.tasks.front(),
                      .seed = experiment.first_seed,
                      .duration = experiment.duration,
                      .digest = fmt::format("{:016x}", session.digest()),
                      .sessions = {}};
    for (const experiment::NamedAlgorithm& algorithm : experiment.algorithms) {
        const auto spec = experiment::make_session_spec(
            experiment,
            {algorithm, experiment.hands, experiment.tasks.front(), experiment.first_seed,
             experiment::parties_of(experiment).front()},
            experiment.path);
        report.duration = spec.setting.length;
        const auto trace = virtual_time::play(spec.setting, nullptr, virtual_time::PlaysOn::always);
        if (!trace) return tl::unexpected{trace.error()};
        report.sessions.push_back({algorithm.name, metrics::metrics_of(*trace)});
    }
    if (command.json) {
        fmt::print("{}\n", base::json_of(report).dump(2));
        return 0;
    }
    for (const PlayedSession& one : report.sessions) {
        const auto& apart = one.metrics.discrepancy_m;
        net::print(fmt::format("{}, {}, seed {}: {}\n", one.algorithm, name_of(report.task),
                               report.seed,
                               apart ? fmt::format("copies {:.2f} mm apart in the mean, {:.2f} mm "
                                                   "at most",
                                                   apart->mean * 1e3, apart->max * 1e3)
                                     : "no session began"));
    }
    return 0;
}

/// A socket and the object that answers it.
struct Served {
    std::unique_ptr<control::Server> server;
    control::Subject subject;
};

/// Stores saved experiments in a folder: experiment-1.toml, ...
class SavedExperiments {
public:
    explicit SavedExperiments(std::string folder) : folder_{std::move(folder)} {}

    /// A motion without a name is stored in a file beside the experiment's, which refers to it.
    [[nodiscard]] base::Result<std::string> save(experiment::Experiment saved)
    {
        if (folder_.empty()) return base::fail("start it with --out DIR to save experiments");
        std::string path;
        do {
            path = fmt::format("{}/experiment-{}.toml", folder_, ++count_);
        } while (std::filesystem::exists(path));
        for (experiment::NamedTrace& way : saved.replay) {
            if (!way.trace || !way.name.empty()) continue;
            way.name = fmt::format("experiment-{}-hand.csv", count_);
            disk::ResultFile{folder_ + "/" + way.name}.commit(device::print_hand_trace(*way.trace));
        }
        disk::ResultFile{path}.commit(experiment::to_text(saved));
        return path;
    }

private:
    std::string folder_;
    int count_ = 0;
};

template <typename Played>
void play_a_turn(Played& session, live::Pace& pace, base::Duration passed, base::Duration tick)
{
    if (session.is_over()) return pace.pause(); // so that a seek back does not play on
    if (const auto due = pace.due(passed, tick)) return session.play_on(*due);
    const auto end = net::monotonic_now() + playing_max;
    while (!session.is_over() && net::monotonic_now() < end) session.play_on(played_at_once);
}

/// Plays until it is stopped.
template <typename Played>
int play_live(const PlayCommand& command, Played& session, base::Duration tick)
{
    net::StopSignal stop;
    if (!command.out.empty()) create_folder(command.out);
    SavedExperiments saved{command.out};
    live::Pace pace{command.pace, !command.paused};
    bool is_over = false;
    const live::Controlled<Played> controlled{
        session, pace, [&saved](experiment::Experiment one) { return saved.save(std::move(one)); },
        [&is_over] { is_over = true; }};
    std::vector<Served> all;
    all.push_back(
        {std::make_unique<control::Server>(command.control, limits), live::subject_of(controlled)});
    for (std::size_t seat = 0; seat < session.peers(); ++seat) {
        all.push_back({std::make_unique<control::Server>(
                           fmt::format("{}.peer-{}", command.control, seat + 1), limits),
                       live::peer_subject(controlled, seat)});
    }
    std::vector<int> descriptors{stop.descriptor()};
    for (const Served& one : all) descriptors.push_back(one.server->descriptor());
    net::print_now(fmt::format("ready control={} peers={}\n", command.control, session.peers()));
    auto last = net::monotonic_now();
    while (!stop.requested() && !is_over) {
        const auto now = net::monotonic_now();
        play_a_turn(session, pace, now - std::exchange(last, now), tick);
        const auto end = now + turn;
        while (!stop.requested() && !is_over) {
            auto deadline = std::optional{end};
            for (const Served& one : all) {
                one.server->serve(one.subject, net::monotonic_now());
                deadline = base::earlier(deadline, one.server->next_deadline());
            }
            if (base::is_due(end, net::monotonic_now())) break;
            net::wait_readable(descriptors, deadline);
        }
    }
    return 0;
}

/// Plays a recorded session.
base::Result<int> play_records(const PlayCommand& command)
{
    const auto a = read_record(command.experiment);
    if (!a) return tl::unexpected{a.error()};
    const auto b = read_record(command.record);
    if (!b) return tl::unexpected{b.error()};
    const auto recording = live::Recording::make(*a, *b);
    if (!recording) {
        return base::fail(fmt::format("cannot play {} with {}: {}", command.experiment,
                                      command.record, recording.error().message));
    }
    return play_live(command, **recording, (*recording)->tick());
}

} // namespace

base::Result<int> play_session(const PlayCommand& command)
{
    if (!command.record.empty()) return play_records(command);
    auto experiment = experiment_of(command);
    if (!experiment) return tl::unexpected{experiment.error()};
    if (auto opened = load_own_algorithms(*experiment); !opened) {
        return tl::unexpected{opened.error()};
    }
    auto session =
        live::Session::make(*experiment, preset_text,
                            command.device == "page" ? live::Session::HandOfA::page
                                                     : live::Session::HandOfA::simulated);
    if (!session) return tl::unexpected{session.error()};
    if (command.control.empty()) return play_out(command, **session, *experiment);
    return play_live(command, **session, experiment->tick);
}

} // namespace hapnet::lab
