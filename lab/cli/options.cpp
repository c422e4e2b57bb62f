// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/options.hpp"

#include "emulator/core/profile/settings.hpp"
#include "lab/cli/exit_codes.hpp"
#include "lab/cli/fit_command.hpp"
#include "lab/cli/import_command.hpp"
#include "lab/cli/schemas.hpp"
#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/fields.hpp"
#include "lab/experiment/text.hpp"
#include "lab/live/pace.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/ensure.hpp"
#include "proto/cli/command.hpp"
#include "proto/cli/parsers.hpp"
#include "proto/cli/synonyms.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"

#include <cstdlib>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

constexpr const char* description =
    "Runs experiments in virtual time, on the same code as the daemons. Analyses, exports and "
    "replays the records of hapnet-peer. Explains scenes.";

constexpr const char* footer =
    R"(Examples:
  hapnet-lab run table1 --out results/table1
  hapnet-lab run fig6a --quick --out results/fig6a
  hapnet-lab plan plane --seeds 100 --out sweep
  hapnet-lab run sweep --shard 0/16
  hapnet-lab merge sweep
  hapnet-lab compare results/a results/b
  hapnet-lab import hands a.csv b.csv --units mm --rate 120Hz --out people
  hapnet-lab fit hands people --out fitted
  hapnet-lab report results
  hapnet-lab report a.rec b.rec
  hapnet-lab analyse a.rec b.rec --json
  hapnet-lab export a.rec > a.csv
  hapnet-lab export a.rec b.rec > both.csv
  hapnet-lab export a.rec b.rec --mcap > both.mcap
  hapnet-lab replay a.rec --algorithm dead-reckoning
  hapnet-lab explain paper)";

constexpr const char* exit_codes = R"(  0  done
  1  the run failed, or a comparison did not hold
  2  bad usage or input
  3  the system refused (no permission, disk full))";

constexpr const char* demo_exit_codes = R"(  0  done
  1  a row is missed, or the run is not valid
  2  bad usage or input
  3  the system refused (no permission, disk full))";

constexpr const char* replay_exit_codes =
    R"(  0  the forces are the recorded ones; with another algorithm always
  1  with the recorded algorithm, the forces differ from the recorded ones
  2  bad usage or input
  3  the system refused (no permission, disk full))";

/// Returns the names of built-in things: "paper, lift, wall".
template <typename BuiltIn>
std::string names_of(std::span<const BuiltIn> all)
{
    std::vector<std::string_view> names;
    for (const BuiltIn& one : all) names.push_back(one.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

void add_analyse(cli::Command& command, AnalyseCommand& analyse)
{
    command.add_alias("analyze");
    command.describe(
        "Compares the records of the peers of one session, two to eight: how far apart "
        "their cubes and forces were, what the network did, and whether the run is "
        "valid. Of two, the first record is A and the second B. An invalid run is reported; the "
        "exit code stays 0.");
    command.add_exit_codes(exit_codes_without_run);
    command.positional("RECORD_A", "The record of one peer", cli::into(analyse.record_a))
        .required("a.rec b.rec");
    command.positional("RECORD_B", "The record of another", cli::into(analyse.record_b))
        .required("a.rec b.rec");
    command.positional("MORE", "The records of all others", cli::onto(analyse.more)).repeated();
    command.flag("--json", "Print one JSON object instead of a table", analyse.json);
}

void add_export(cli::Command& command, ExportCommand& exported, bool& as_csv)
{
    command.describe(
        "Prints the rows of a record as CSV, or all poses and forces as MCAP. Times of "
        "CSV count from the start of its "
        "session. Of the records of both peers it prints the ticks of their last "
        "common session on one time axis: each tick of the first with the last tick "
        "of the other that is not later.");
    command.add_exit_codes(exit_codes_without_run);
    command.positional("RECORD", "The record of one peer", cli::into(exported.record))
        .required("a.rec");
    command.positional("OTHER", "The record of the other peer, to join the two",
                       cli::into(exported.other));
    command.flag("--csv", "As CSV: the default", as_csv);
    command.flag("--mcap",
                 "As MCAP with messages of ROS 2, PoseStamped and WrenchStamped, for Foxglove, "
                 "Lichtblick and PlotJuggler; of the records of both peers both are in it",
                 exported.as_mcap);
    command.option(
        "--rows", "ticks|messages|bodies",
        "Ticks of the haptic loop, messages received, or where each tick left the shared "
        "bodies (default ticks)",
        cli::into(exported.rows, cli::named<ExportRows>));
}

/// Adds options for facts that a script knows and hapnet-lab does not.
void add_circumstances(cli::Command& command, auto& run)
{
    constexpr double seconds_max = 1e9;
    command.option("--command", "LINE", "The command line, for the manifest",
                   cli::into(run.command));
    command.option("--start", "TIME", "When it began (ISO 8601), for the manifest",
                   cli::into(run.start));
    command.option("--wall-time", "SECONDS", "How long it took, for the manifest",
                   cli::into(run.wall_time_s, base::Number{0.0, seconds_max}));
}

cli::Command& add_demo_report(cli::Command& program, DemoReportCommand& demo)
{
    auto& command = program.command("demo-report", "The last step of scripts/demo.sh");
    command.describe("The last step of scripts/demo.sh: reads the records in a folder, prints them "
                     "beside the paper's Table 1, and writes manifest.json and report.html. For T7 "
                     "and T8 it writes manifest.json and says whether the run is valid.");
    command.positional("DIR", "The folder of scripts/demo.sh", cli::into(demo.folder))
        .required("results/demo");
    command.add_exit_codes(demo_exit_codes);
    add_circumstances(command, demo);
    return command;
}

void add_report(cli::Command& command, ReportCommand& report)
{
    command.describe(
        "Writes report.html, one self-contained page. Of a folder: "
        "the results of its experiments beside the paper, of the demo, or of a "
        "recorded session; of a folder of such folders, without a manifest.json of its own, it "
        "writes one. The tables are read from results.json: run again what an older version "
        "wrote. Of two records or more: their session; the page is written "
        "beside the first. The numbers of figures that no file of results has go to figures/ "
        "beside the page.");
    command.add_exit_codes(exit_codes_without_run);
    command
        .positional("DIR|RECORD_A",
                    "A folder of results or of such folders; or the record of one peer",
                    cli::into(report.path))
        .required("results");
    command.positional("RECORD_B", "The record of another peer", cli::into(report.record_b));
    command.positional("MORE", "The records of all others", cli::onto(report.more)).repeated();
    command.option("--out", "FILE",
                   "Where the page goes (default: report.html in the folder, or beside RECORD_A)",
                   cli::into(report.out));
}

cli::Command& add_replay(cli::Command& program, ReplayCommand& replay)
{
    auto& command = program.command("replay", "Replays a recorded peer in virtual time");
    command.describe("Replays one recorded peer in virtual time, with the messages it received and "
                     "the hand it had, and compares the forces. A record that was cut off is "
                     "replayed as far as it goes, with "
                     "a note.");
    command.positional("RECORD", "The record of one peer", cli::into(replay.record))
        .required("a.rec");
    command.option("--algorithm", "NAME|FILE",
                   "Another algorithm than the recorded one, fed with the same messages",
                   cli::into(replay.algorithm, [](const std::string& text) {
                       return cli::meant_value("--algorithm", text);
                   }));
    command.flag("--json", "Print one JSON object instead of lines", replay.json);
    command.flag("--csv", "Print the recorded and replayed forces of every tick", replay.csv);
    command.add_exit_codes(replay_exit_codes);
    return command;
}

cli::Command& add_real_time(cli::Command& program, RealTimeCommand& real_time)
{
    auto& command = program.command("real-time", "The last step of scripts/real-time.sh");
    constexpr std::uint64_t attempts_max = 100;
    command.describe("The last step of scripts/real-time.sh: reads the sessions that ran in real "
                     "time, plays the same in virtual time, and writes real_time.csv; or, in the "
                     "folder of a plan, real_time_sessions.csv and real_time_conditions.csv.");
    command
        .positional("DIR", "The folder of results that holds real-time/",
                    cli::into(real_time.folder))
        .required("results");
    command.flag(
        "--next",
        "Of the plan in DIR: write the files of the next session that is to be played, "
        "and print its folder, peers, task, seconds, seed and words, with tabs between; nothing "
        "when all are played",
        real_time.next);
    command.option("--attempts", "N", "How often a session is played that is not valid (default 3)",
                   cli::into(real_time.attempts, base::Count{1, attempts_max}));
    command.option("--played", "FOLDER",
                   "Read the session that was played into this folder, and compare it",
                   cli::into(real_time.played));
    command.flag("--keep-records", "With --played: keep the records in the folder",
                 real_time.keep_records);
    command.add_exit_codes(exit_codes_without_run);
    add_circumstances(command, real_time);
    return command;
}

void add_explain(cli::Command& command, ExplainCommand& explain, bool& no_sleeping)
{
    command.describe("Describes a scene, the features that it needs and why, and the cheapest "
                     "stepper that has them. What a scene does not need costs nothing.");
    command.add_exit_codes(exit_codes_without_run);
    command
        .positional("SCENE",
                    fmt::format("A file (docs/formats/scene.md), or one of {}",
                                names_of(scene::built_in_scenes())),
                    cli::into(explain.scene))
        .required("paper");
    command.option("--tick", "TIME", "Length of a tick, from 10us to 100ms (default 1ms)",
                   cli::into(explain.tick, base::Time{scene::tick_min, scene::tick_max}));
    command.flag("--no-sleeping", "Keep bodies at rest awake", no_sleeping);
    command.flag("--json", "Print one JSON object instead of lines", explain.json);
}

void add_jobs(cli::Command& command, std::optional<unsigned>& jobs)
{
    constexpr std::uint64_t jobs_max = 1024;
    command.option("--jobs", "N",
                   "Number of threads; the results do not depend on it (default: all processors)",
                   cli::into(jobs, base::Count{1, jobs_max}));
}

/// Adds the options that choose an experiment and change it.
void add_experiment(cli::Command& command, RunCommand& run, const std::string& what)
{
    command
        .positional(
            "EXPERIMENT",
            fmt::format("{}, or one of {}", what, names_of(experiment::built_in_experiments())),
            cli::into(run.experiment))
        .required("table1 --out results/table1");
    command
        .option("--set", "KEY=VALUE",
                "Another value for a key of the experiment, such as both.delay=100ms; may be given "
                "several times",
                cli::onto(run.settings))
        .repeated();
    command.option("--seeds", "N", "Number of seeds (default: the experiment's)",
                   cli::into(run.seeds, base::Count{1, experiment::seeds_max}));
    command.option(
        "--criteria", "FILE",
        "Thresholds that a usable session keeps: a file (docs/design/metrics.md), or paper "
        "(default), calibrated on the paper",
        cli::into(run.criteria));
    command.flag("--quick", "Use the values under [quick] of the experiment: rougher", run.quick);
}

/// Returns a reader that stores a condition in both directions as a setting of the experiment.
cli::Take condition_into(std::vector<std::string>& settings, std::string_view key)
{
    return [&settings, key](const std::string& text) -> base::Result<void> {
        const auto setting = emulator::parse_setting(key, text, {}, {});
        if (!setting && !text.starts_with('{')) {
            const std::string_view why = setting.error().message;
            return base::fail(std::string{why.substr(key.size() + 2)});
        }
        settings.push_back(fmt::format("both.{}={}", key, text));
        return {};
    };
}

/// Reads "paused", "max", or a factor.
cli::Take pace_into(PlayCommand& play)
{
    return [&play](const std::string& text) -> base::Result<void> {
        play.paused = text == "paused";
        if (play.paused) return {};
        if (text == "max") {
            play.pace.reset();
            return {};
        }
        char* end = nullptr;
        const double factor = std::strtod(text.c_str(), &end);
        const bool is_whole = !text.empty() && *end == '\0';
        if (!is_whole || !(factor >= live::Pace::factor_min && factor <= live::Pace::factor_max)) {
            return base::fail(fmt::format("'{}': write a number from {} to {}, max or paused", text,
                                          live::Pace::factor_min, live::Pace::factor_max));
        }
        play.pace = factor;
        return {};
    };
}

/// Reads the name of a built-in algorithm.
cli::Take algorithm_into(std::vector<std::string>& algorithms)
{
    return [&algorithms](const std::string& text) -> base::Result<void> {
        if (text.find(',') != std::string::npos) {
            return base::fail(fmt::format("there is no algorithm '{}': give --algorithm once for "
                                          "each, such as --algorithm base --algorithm sep",
                                          text));
        }
        const auto name = cli::meant_value("--algorithm", text);
        if (!name) return tl::unexpected{name.error()};
        if (const auto known = peer::algorithm_named(*name); !known)
            return tl::unexpected{known.error()};
        algorithms.push_back(*name);
        return {};
    };
}

void add_play(cli::Command& command, PlayCommand& play)
{
    command.describe("Plays one session in virtual time and prints its numbers. With --control it "
                     "is there to be watched: hapnet-web --lab SOCKET shows it, and hapnet-ctl "
                     "SOCKET changes its network. With two records it shows the session that they "
                     "are of, as it was.");
    command.add_footer("Examples:\n"
                       "  hapnet-lab play --task T3 --loss 93% --json\n"
                       "  hapnet-lab play --algorithm base --algorithm sep --delay 160ms\n"
                       "  hapnet-lab play --profile wifi-busy --control /tmp/lab.sock --pace 10\n"
                       "  hapnet-lab play a.rec b.rec --control /tmp/lab.sock");
    command.positional("EXPERIMENT",
                       "A file, or a built-in experiment: its first task and seed, and up to three "
                       "algorithms, instead of the options. Or the record of one peer",
                       cli::into(play.experiment));
    command.positional("RECORD", "The record of the other peer", cli::into(play.record));
    command.option("--task", "NAME", "P1 (default) or T1 to T10", cli::into(play.task));
    command
        .option("--algorithm", "NAME", "base (default); up to three play under the same network",
                algorithm_into(play.algorithms))
        .repeated();
    command.option("--profile", "FILE|NAME", "Conditions and their timeline",
                   cli::into(play.profile));
    for (const char* key : {"delay", "jitter", "loss"}) {
        command.option(fmt::format("--{}", key), "VALUE", fmt::format("The {}, both ways", key),
                       condition_into(play.settings, key));
    }
    command
        .option("--set", "KEY=VALUE", "Another value for a key of the experiment",
                cli::onto(play.settings))
        .repeated();
    command.option("--seed", "N", "The seed of all random draws (default 1)",
                   cli::into(play.seed, base::Count{1, 1'000'000'000}));
    command.option(
        "--duration", "TIME", "How long the session lasts (default 30s)",
        cli::into(play.duration, base::Time{std::chrono::seconds{5}, std::chrono::seconds{600}}));
    command.option("--peers", "N", "How many play (default 2)",
                   cli::into(play.peers, base::Count{2, 8}));
    command.flag("--json", "Print one JSON object instead of lines", play.json);
    command.option("--control", "SOCKET",
                   "Wait on this Unix socket, and on SOCKET.peer-1 and so on, for whoever watches",
                   cli::into(play.control));
    command.option("--device", "sim|page",
                   "With --control: A's hand is simulated (default), or goes where clients of "
                   "SOCKET.peer-1 tell it to with the command hand",
                   [&play](const std::string& text) -> base::Result<void> {
                       if (text != "sim" && text != "page")
                           return base::fail(fmt::format("'{}': use sim or page", text));
                       play.device = text;
                       return {};
                   });
    command.option("--out", "DIR", "With --control: where experiments are saved",
                   cli::into(play.out));
    command.option("--pace", "FACTOR",
                   "With --control: seconds played in a second (default 1), max or paused",
                   pace_into(play));
}

/// Completes the options after the command line was read. Refuses options that contradict each
/// other.
base::Result<void> complete(PlayCommand& play, const cli::Command& command)
{
    if (!play.record.empty()) {
        for (const char* option :
             {"--task", "--algorithm", "--profile", "--delay", "--jitter", "--loss", "--set",
              "--seed", "--duration", "--peers", "--json", "--device", "--out"}) {
            if (command.is_given(option)) {
                return base::fail(
                    fmt::format("play: a record is played as it is: leave {} out", option));
            }
        }
        if (play.control.empty()) {
            return base::fail("play: records are played for those who watch: add --control SOCKET");
        }
    }
    if (play.algorithms.empty()) play.algorithms = {"base"};
    if (play.control.empty() && (!play.out.empty() || command.is_given("--pace"))) {
        return base::fail("play: --out and --pace go with --control");
    }
    if (play.control.empty() && play.device == "page") {
        return base::fail(
            "play: the hand of --device page is moved over a socket: add --control SOCKET");
    }
    if (!play.control.empty() && play.json) {
        return base::fail("play: --json is for a session that plays to its end: leave --control "
                          "out");
    }
    return {};
}

void add_run(cli::Command& command, RunCommand& run)
{
    command.describe("Runs an experiment in virtual time and writes its results as CSV. Run again "
                     "after Ctrl-C, or with more seeds, it plays only the missing sessions.");
    command.add_footer("Examples:\n"
                       "  hapnet-lab run table1 --out results/table1\n"
                       "  hapnet-lab run fig6b --seeds 40 --jobs 2 --out results/fig6b\n"
                       "  hapnet-lab run mine.toml --set both.delay=100ms --out results/mine\n"
                       "  hapnet-lab run any-network --set latin_hypercube.points=20 --out r\n"
                       "  hapnet-lab run table1 --set axis.key=hands --out results/hands \\\n"
                       "    --set 'axis.values=[\"relaxed\", \"firm\"]'");
    add_experiment(command, run,
                   "A file (docs/use/experiments.md), a plan (the folder that hapnet-lab plan "
                   "wrote)");
    command.option("--out", "DIR", "The folder for the results (default: of a plan its own)",
                   cli::into(run.out));
    command.option("--shard", "I/N",
                   "Of a plan only the sessions of shard I, from 0 to N-1; they go to DIR/shards, "
                   "where hapnet-lab merge finds them",
                   cli::into(run.shard, experiment::parse_shard));
    add_jobs(command, run.jobs);
}

cli::Command& add_plan(cli::Command& program, PlanCommand& plan)
{
    auto& command = program.command("plan", "Writes down an experiment to be run in shards");
    command.describe("Writes down an experiment with all files that it needs, to be run in shards, "
                     "on as many machines as there are, and merged.");
    command.add_footer("Examples:\n"
                       "  hapnet-lab plan plane --seeds 100 --out sweep\n"
                       "  hapnet-lab run sweep --shard 0/16\n"
                       "  hapnet-lab merge sweep");
    command.add_exit_codes(exit_codes_without_run);
    add_experiment(command, plan.run, "A file (docs/use/experiments.md)");
    command.option("--out", "DIR", "The folder for plan.json", cli::into(plan.run.out))
        .required("sweep");
    return command;
}

cli::Command& add_merge(cli::Command& program, MergeCommand& merge)
{
    auto& command = program.command("merge", "Writes the results of a plan's shards");
    command.describe("Writes the results of a plan from the sessions of its shards: the same bytes "
                     "as one run would, and a digest of them. Exit code 1: sessions are missing.");
    command.positional("DIR", "The folder that hapnet-lab plan wrote", cli::onto(merge.folders))
        .required("sweep");
    command
        .positional("MORE", "Other folders with shards, from machines with other disks",
                    cli::onto(merge.folders))
        .repeated();
    add_jobs(command, merge.jobs);
    return command;
}

cli::Command& add_compare(cli::Command& program, CompareCommand& compare)
{
    auto& command = program.command("compare", "Compares two folders of results");
    command.describe(
        "Compares two folders of results session by session: the sessions that both have, by the "
        "same algorithm, in the same task, scene, network and with the same seed. Of what each is "
        "measured by: the median of B - A with its 95 % interval, and the p of a sign test.");
    command.add_exit_codes(exit_codes_without_run);
    command
        .positional("DIR_A", "A folder of results, with sessions.json", cli::into(compare.folder_a))
        .required("results/before results/after");
    command.positional("DIR_B", "Another", cli::into(compare.folder_b))
        .required("results/before results/after");
    command.flag("--json", "Print one JSON object instead of a table", compare.json);
    command.flag("--csv", "Print the table as CSV", compare.csv);
    return command;
}

/// Returns the names that command lines and experiments can use, a line for each kind of them.
std::string list_of_names()
{
    const auto line = [](std::string_view what, const std::string& names) {
        return fmt::format("{:<12} {}\n", what, names);
    };
    return line("experiments", names_of(experiment::built_in_experiments())) +
           line("criteria", names_of(experiment::built_in_criteria())) +
           line("scenes", names_of(scene::built_in_scenes())) +
           line("algorithms", fmt::format("{}", fmt::join(peer::algorithm_names, ", "))) +
           line("tasks", fmt::format("{}", fmt::join(base::names_of_enum<device::Task>, ", ")));
}

void describe_program(cli::Command& program)
{
    program.describe(description);
    program.add_footer(footer);
    program.add_exit_codes(exit_codes);
    program.require_command();
}

/// Refuses options of these commands that contradict each other. `command` is that of `exported`.
base::Result<void> check(const ReplayCommand& replay, const CompareCommand& compare,
                         const ExportCommand& exported, const cli::Command& command)
{
    if ((replay.json && replay.csv) || (compare.json && compare.csv))
        return base::fail("--json and --csv exclude each other: give one of them");
    if (exported.as_mcap && (command.is_given("--rows") || command.is_given("--csv")))
        return base::fail("--mcap has all that ticks and bodies hold: leave --csv and --rows out");
    if (!exported.other.empty() && exported.rows != ExportRows::ticks) {
        return base::fail("export: of two records only the ticks can be joined: leave --rows out, "
                          "or give one record");
    }
    return {};
}

/// Returns the chosen one of the commands, with its options.
template <typename... Options>
Command chosen_of(std::tuple<cli::Command&, Options&>... offers)
{
    std::optional<Command> chosen;
    const auto take = [&](const cli::Command& command, auto& options) {
        if (command.is_chosen()) chosen = Command{std::move(options)};
    };
    (std::apply(take, offers), ...);
    base::ensure(chosen.has_value());
    return *std::move(chosen);
}

} // namespace

net::CommandLine<Command> parse_command_line(std::span<char*> words)
{
    cli::Command program{"hapnet-lab"};
    describe_program(program);
    const auto& list_command = program.command("list", "Prints the names of what is built in");
    RunCommand run;
    auto& run_command = program.command("run", "Runs an experiment in virtual time");
    add_run(run_command, run);
    PlanCommand plan;
    auto& plan_command = add_plan(program, plan);
    MergeCommand merge;
    auto& merge_command = add_merge(program, merge);
    CompareCommand compare;
    auto& compare_command = add_compare(program, compare);
    ReportCommand report;
    auto& report_command =
        program.command("report", "Writes a page with the results of a folder or session");
    add_report(report_command, report);
    ImportHandsCommand import_hands;
    auto& import_command = add_import(program, import_hands);
    FitHandsCommand fit_of_hands;
    auto& fit_command = add_fit(program, fit_of_hands);
    AnalyseCommand analyse;
    auto& analyse_command =
        program.command("analyse", "Compares the records of the peers of a session");
    add_analyse(analyse_command, analyse);
    ExportCommand exported;
    bool as_csv = true, no_sleeping = false;
    auto& export_command = program.command("export", "Prints the rows of a record as CSV");
    add_export(export_command, exported, as_csv);
    ReplayCommand replay;
    auto& replay_command = add_replay(program, replay);
    PlayCommand play;
    auto& play_command = program.command("play", "Plays one session in virtual time");
    add_play(play_command, play);
    ExplainCommand explain;
    auto& explain_command = program.command("explain", "Describes a scene and its stepper");
    add_explain(explain_command, explain, no_sleeping);
    DemoReportCommand demo;
    auto& demo_command = add_demo_report(program, demo);
    RealTimeCommand real_time;
    auto& real_time_command = add_real_time(program, real_time);
    const cli::SchemaCommand schema{program, schemas()};
    if (auto said = program.parse(words); !said || *said) return net::answer_of(std::move(said));
    if (schema.is_chosen()) return net::Answer{schema.text()};
    if (list_command.is_chosen()) return net::Answer{list_of_names()};
    auto fine = check(replay, compare, exported, export_command);
    if (!fine || !(fine = complete(play, play_command))) return tl::unexpected{fine.error()};
    explain.sleeping = !no_sleeping;
    run.command = merge.command = fmt::format("{}", fmt::join(words, " "));
    return chosen_of(std::tie(analyse_command, analyse), std::tie(export_command, exported),
                     std::tie(demo_command, demo), std::tie(real_time_command, real_time),
                     std::tie(play_command, play), std::tie(replay_command, replay),
                     std::tie(report_command, report), std::tie(explain_command, explain),
                     std::tie(run_command, run), std::tie(plan_command, plan),
                     std::tie(merge_command, merge), std::tie(compare_command, compare),
                     std::tie(import_command, import_hands), std::tie(fit_command, fit_of_hands));
}

} // namespace hapnet::lab
