// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/fit_command.hpp"

#include "lab/cli/exit_codes.hpp"
#include "lab/cli/files.hpp"
#include "lab/hands/population.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <cstdio>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;

/// An experiment that ranks the algorithms with the unseen trials, with the seen ones and with the
/// simulated ones. The seen trials show how much people's own rankings differ.
constexpr const char* judging_experiment =
    R"(# Run this with hapnet-lab run: rankings.csv compares the orders of the algorithms.
title = "do the simulated hands rank the algorithms as these people do?"
kind = "table1"
duration = "script"
seeds = 1
algorithms = ["base", "sep", "dead-reckoning", "remote-proxy"]
tasks = ["T3"]
hands = "unseen/"

[both]
delay = "100ms"

[axis]
key = "hands"
values = ["unseen/", "seen/", "simulated/"]
)";

void write(const fs::path& path, const std::string& text)
{
    disk::ResultFile{path.string()}.commit(text);
}

/// Writes a population in place of the one that an earlier fit wrote. `script` returns the text of
/// a script by its name.
template <typename Script>
base::Result<void> write_population(const fs::path& folder, const hands::Manifest& manifest,
                                    const Script& script)
{
    if (fs::exists(folder / hands::manifest_name)) {
        for (const auto& entry : fs::directory_iterator{folder})
            if (entry.path().extension() == ".csv") fs::remove(entry.path());
    }
    create_folder(folder.string());
    for (const hands::ImportedTrial& trial : manifest.trials) {
        for (const hands::ImportedHand* hand : {&trial.a, trial.b ? &*trial.b : nullptr}) {
            if (hand == nullptr) continue;
            const base::Result<std::string> text = script(hand->script);
            if (!text) return tl::unexpected{text.error()};
            write(folder / hand->script, *text);
        }
    }
    write(folder / hands::manifest_name, to_text(manifest));
    return {};
}

} // namespace

cli::Command& add_fit(cli::Command& program, FitHandsCommand& fit)
{
    auto& group = program.command("fit", "Fits simulated hands to recorded ones");
    group.describe("Fits what is simulated to what was recorded.");
    group.require_command();
    auto& command = group.command("hands", "Makes simulated hands that move as recorded people do");
    command.describe(
        "Fits simulated hands to a part of the trials of a folder that import hands has written, "
        "and judges them by the others. Writes to the folder --out: fit.json, with the models and "
        "how the figures of recorded and simulated motion compare; seen/ and unseen/, the trials "
        "that the fit saw and the others; simulated/, trials drawn from the models; and "
        "judge.toml, an experiment that ranks the algorithms with each of the three.");
    command.add_footer("Examples:\n"
                       "  hapnet-lab fit hands people --out fitted\n"
                       "  hapnet-lab run fitted/judge.toml --out results/judge\n"
                       "  hapnet-lab fit hands people --unseen 02,03 --trials 20 --out fitted");
    command.add_exit_codes(exit_codes_without_run);
    command.positional("DIR", "A folder of recorded hands", cli::into(fit.people))
        .required("people");
    command.option("--unseen", "half|NAMES",
                   "Which trials judge the fit: each second trial of every subject (half, the "
                   "default), or all trials of these subjects, with commas between their names",
                   cli::into(fit.rules.unseen, hands::parse_unseen));
    command.option("--trials", "N",
                   "Simulated trials of each fitted subject (default: as many as it has)",
                   cli::into(fit.rules.trials, base::Count{1, 1000}));
    command.option("--seed", "N", "Seed of the simulated trials (default 1)",
                   cli::into(fit.rules.seed, base::Count{1, 1'000'000'000}));
    command.option("--out", "DIR", "The folder for the results", cli::into(fit.out))
        .required("fitted");
    return command;
}

base::Result<std::string> fit_hands(const FitHandsCommand& command)
{
    const fs::path people{command.people}, out{command.out};
    if (command.out.empty()) return base::fail("--out: name a folder");
    for (const char* part : {"seen", "unseen", "simulated"}) {
        const fs::path folder = out / part;
        const bool is_of_a_fit = fs::exists(out / "fit.json");
        const bool is_input =
            fs::exists(folder) && fs::exists(people) && fs::equivalent(folder, people);
        if (!is_input && (is_of_a_fit || !fs::exists(folder / hands::manifest_name))) continue;
        return base::fail(fmt::format("--out {}: {} would be overwritten: choose another folder",
                                      command.out, folder.string()));
    }
    const auto manifest_path = (people / hands::manifest_name).string();
    const auto text = net::text_of_file(manifest_path);
    if (!text) return tl::unexpected{text.error()};
    const auto manifest = hands::parse_manifest(*text, manifest_path);
    if (!manifest) return tl::unexpected{manifest.error()};
    const auto population =
        hands::read_population(command.people, base::Reading{command.people, net::text_of_file});
    if (!population) return tl::unexpected{population.error()};
    create_folder(command.out);
    hands::ImitationRules rules = command.rules;
    rules.on_subject = [](const std::string& subject) {
        fmt::print(stderr, "fitting a hand to subject {}\n", subject);
    };
    const auto imitated = hands::imitate(*manifest, *population, rules);
    if (!imitated)
        return base::fail(fmt::format("{}: {}", command.people, imitated.error().message));
    const auto recorded = [&](const std::string& name) {
        return net::text_of_file((people / name).string());
    };
    for (const auto& [name, part] :
         {std::pair{"seen", &imitated->seen}, std::pair{"unseen", &imitated->unseen}}) {
        const auto fine = write_population(out / name, *part, recorded);
        if (!fine) return tl::unexpected{fine.error()};
    }
    const auto fine = write_population(out / "simulated", imitated->simulated,
                                       [&](const std::string& name) -> base::Result<std::string> {
                                           for (const hands::TextFile& file : imitated->scripts)
                                               if (file.name == name) return file.text;
                                           return base::fail(name + " is missing");
                                       });
    if (!fine) return tl::unexpected{fine.error()};
    write(out / "judge.toml", judging_experiment);
    write(out / "fit.json", to_text(imitated->imitation));
    return told(imitated->imitation) + (out / "fit.json").string() + '\n' +
           (out / "judge.toml").string() + '\n';
}

} // namespace hapnet::lab
