// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/options.hpp"

#include "lab/experiment/read_kind.hpp"
#include "lab/experiment/text.hpp"
#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

CLI::App* add_analyse(CLI::App& app, AnalyseCommand& analyse)
{
    auto* command = app.add_subcommand(
        "analyse", "Compare the records of both peers of one session: how far their cubes and\n"
                   "forces were apart, what the network did, whether the run is valid.\n"
                   "A run that is not valid says so; the exit code stays 0");
    command->add_option("RECORD_A", analyse.record_a, "record of one peer")->required();
    command->add_option("RECORD_B", analyse.record_b, "record of the other")->required();
    command->add_flag("--json", analyse.json, "print one JSON object instead of a table");
    return command;
}

/// The word for its rows is read afterwards.
void add_export(CLI::App& app, ExportCommand& exported, std::string& rows)
{
    auto* command =
        app.add_subcommand("export", "Print the rows of a record, time counted from its T0");
    command->add_option("RECORD", exported.record, "record of one peer")->required();
    command->add_flag_callback(
        "--csv", [] {}, "as CSV: the only format, and the default");
    command->add_option("--rows", rows, "ticks of the haptic loop, or messages received")
        ->option_text("ticks|messages [ticks]")
        ->check(CLI::IsMember{{"ticks", "messages"}});
}

/// What a script knows of a run and hapnet-lab does not.
void add_circumstances(CLI::App& command, auto& run)
{
    command.add_option("--command", run.command, "what was typed, for the manifest");
    command.add_option("--start", run.start, "when it began, for the manifest");
    command.add_option("--wall-time", run.wall_time_s, "seconds since, for the manifest");
}

CLI::App* add_demo_report(CLI::App& app, DemoReportCommand& demo)
{
    auto* command = app.add_subcommand(
        "demo-report", "The end of scripts/demo.sh: read what it recorded in a folder, print it\n"
                       "beside the paper's Table 1, write manifest.json. Exit code 1: it misses");
    command->add_option("FOLDER", demo.folder, "what scripts/demo.sh wrote")->required();
    add_circumstances(*command, demo);
    return command;
}

CLI::App* add_report(CLI::App& app, ReportCommand& report)
{
    auto* command = app.add_subcommand(
        "report", "Write report.html, one page that needs nothing else; also figures/*.svg and\n"
                  "gnuplot/*. Of a folder: what its experiments found, beside the paper, or what\n"
                  "its demo or its recorded session shows. Of two records: their session; the\n"
                  "page is written beside the first");
    command
        ->add_option("PATH", report.paths,
                     "a folder of results, or such a folder's folder; or the records of both peers")
        ->option_text("DIR | RECORD_A RECORD_B")
        ->expected(1, 2)
        ->required();
    return command;
}

CLI::App* add_replay(CLI::App& app, ReplayCommand& replay)
{
    auto* command = app.add_subcommand(
        "replay",
        "Play one recorded peer again in virtual time, with the messages it received and\n"
        "the hand it had, and compare the forces. Exit code 1: they are not the recorded\n"
        "ones. A record that was cut off is played as far as it goes, and that is said");
    command->add_option("RECORD", replay.record, "record of one peer")->required();
    command
        ->add_option("--algorithm", replay.algorithm,
                     "another one than was recorded: what it would have made of the same messages")
        ->option_text("NAME|FILE");
    auto* json = command->add_flag("--json", replay.json, "print one JSON object instead of lines");
    command->add_flag("--csv", replay.csv, "print every tick's recorded and replayed forces")
        ->excludes(json);
    return command;
}

CLI::App* add_real_time(CLI::App& app, RealTimeCommand& real_time)
{
    auto* command = app.add_subcommand(
        "real-time", "The end of scripts/real-time.sh: read the sessions that were played in real\n"
                     "time, play the same in virtual time, write real_time.csv");
    command->add_option("DIR", real_time.folder, "the folder of results that holds real-time/")
        ->required();
    add_circumstances(*command, real_time);
    return command;
}

/// The text of its tick is read afterwards: its complaint is ours.
CLI::App* add_explain(CLI::App& app, ExplainCommand& explain, std::string& tick)
{
    std::vector<std::string_view> names;
    for (const scene::BuiltInScene& built_in : scene::built_in_scenes()) {
        names.push_back(built_in.name);
    }
    auto* command = app.add_subcommand(
        "explain", "Say what a scene is, what it needs of a tick and why, and which tick it\n"
                   "therefore gets: what it does not need costs nothing");
    command
        ->add_option(
            "SCENE", explain.scene,
            fmt::format("a file (docs/formats/scene.md), or one of {}", fmt::join(names, ", ")))
        ->required();
    command->add_option("--tick", tick, "how long a tick is, from 10us to 100ms")
        ->option_text("TIME [1ms]");
    command->add_flag_callback(
        "--no-sleeping", [&explain] { explain.sleeping = false; },
        "bodies at rest do not fall asleep");
    command->add_flag("--json", explain.json, "print one JSON object instead of lines");
    return command;
}

/// Thrown by --list: what else is on the command line does not matter then.
struct ListOfExperiments {};

/// The built-in experiments, a line each: name and title.
std::string list_of_experiments()
{
    std::string list;
    for (const BuiltInExperiment& built_in : built_in_experiments()) {
        const auto experiment =
            parse_experiment(built_in.text, std::string{built_in.name}, Overrides{});
        list += fmt::format("{:<14}{}\n", built_in.name, experiment ? experiment->title : "");
    }
    return list;
}

CLI::App* add_run(CLI::App& app, RunCommand& run)
{
    constexpr std::uint32_t jobs_max = 1024;
    std::vector<std::string_view> names;
    for (const BuiltInExperiment& built_in : built_in_experiments()) names.push_back(built_in.name);
    auto* command = app.add_subcommand(
        "run", "Carry out an experiment in virtual time and write its results as CSV. Run again\n"
               "after Ctrl-C, or with more seeds, it plays only what it has not played yet");
    command
        ->add_option(
            "EXPERIMENT", run.experiment,
            fmt::format("a file (docs/use/experiments.md), or one of {}", fmt::join(names, ", ")))
        ->required();
    command
        ->add_option("--set", run.settings,
                     "another value for a key of the experiment, such as both.delay=100ms")
        ->option_text("KEY=VALUE ...")
        ->expected(1)
        ->take_all();
    command->add_option("--seeds", run.seeds, "how many seeds")
        ->option_text("N")
        ->check(CLI::Range(1U, seeds_max));
    command->add_option("--jobs", run.jobs, "how many threads; does not change the results")
        ->option_text("N [all processors]")
        ->check(CLI::Range(1U, jobs_max));
    command
        ->add_option(
            "--criteria", run.criteria,
            "what a session must keep to be usable: a file (docs/design/metrics.md), or what\n"
            "was calibrated on the paper")
        ->option_text("FILE [paper]");
    command
        ->add_flag_callback(
            "--list", [] { throw ListOfExperiments{}; }, "print the built-in experiments and exit")
        ->trigger_on_parse();
    command->add_flag("--quick", run.quick, "what the experiment says under [quick]: rougher");
    command->add_option("--out", run.out, "the folder for the results")
        ->option_text("DIR")
        ->required();
    return command;
}

net::CommandLine<Command> command_of(RunCommand run, std::span<char*> words)
{
    run.command = fmt::format("{}", fmt::join(words, " "));
    return Command{std::move(run)};
}

net::CommandLine<Command> command_of(ExplainCommand explain, const std::string& tick)
{
    const auto duration = base::parse_duration(tick);
    if (!duration) return base::fail("--tick: " + duration.error().message);
    if (*duration < scene::tick_min || *duration > scene::tick_max) {
        return base::fail(fmt::format("--tick: '{}' is out of range: {} to {} is possible", tick,
                                      base::to_text(scene::tick_min),
                                      base::to_text(scene::tick_max)));
    }
    explain.tick = *duration;
    return Command{explain};
}

} // namespace

net::CommandLine<Command> parse_command_line(std::span<char*> words)
{
    CLI::App app{"Carries out experiments in virtual time, reads the records of hapnet-peer, and "
                 "explains scenes",
                 "hapnet-lab"};
    app.set_version_flag("--version", base::version_line("hapnet-lab"));
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done, 1 failed, 2 usage or bad input, 3 the environment.");

    AnalyseCommand analyse;
    auto* analyse_command = add_analyse(app, analyse);
    ExportCommand exported;
    std::string rows = "ticks";
    add_export(app, exported, rows);
    DemoReportCommand demo;
    auto* demo_command = add_demo_report(app, demo);
    RealTimeCommand real_time;
    auto* real_time_command = add_real_time(app, real_time);
    ReplayCommand replay;
    auto* replay_command = add_replay(app, replay);
    ReportCommand report;
    auto* report_command = add_report(app, report);
    ExplainCommand explain;
    std::string tick = "1ms";
    auto* explain_command = add_explain(app, explain, tick);

    RunCommand run;
    auto* run_command = add_run(app, run);

    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        const auto chosen = app.get_subcommands();
        return net::Answer{chosen.empty() ? app.help() : chosen.front()->help()};
    } catch (const ListOfExperiments&) {
        return net::Answer{list_of_experiments()};
    } catch (const CLI::CallForVersion&) {
        return net::Answer{base::version_line("hapnet-lab") + "\n"};
    } catch (const CLI::RequiredError& error) {
        const bool names_one = words.size() > 1 && app.get_subcommands().empty();
        if (!names_one) return base::fail(std::string{error.what()} + "; see hapnet-lab --help");
        return base::fail(std::string{"'"} + words[1] +
                          "' is not a command; use analyse, explain, export, replay, report or "
                          "run, "
                          "see hapnet-lab --help");
    } catch (const CLI::ParseError& error) {
        return base::fail(std::string{error.what()} + "; see hapnet-lab --help");
    }
    if (analyse_command->parsed()) return Command{analyse};
    if (demo_command->parsed()) return Command{demo};
    if (real_time_command->parsed()) return Command{real_time};
    if (replay_command->parsed()) return Command{replay};
    if (report_command->parsed()) return Command{report};
    if (explain_command->parsed()) return command_of(explain, tick);
    if (run_command->parsed()) return command_of(std::move(run), words);
    exported.rows = rows == "messages" ? ExportRows::messages : ExportRows::ticks;
    return Command{exported};
}

} // namespace hapnet::lab
