// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/run_command.hpp"

#include "lab/cli/experiment_run.hpp"
#include "lab/cli/files.hpp"
#include "lab/cli/plan.hpp"
#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/parts.hpp"
#include "lab/experiment/text.hpp"
#include "proto/base/version.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::lab {

namespace {

base::Result<std::uint64_t> hash_of_file(const std::string& path)
{
    return net::text_of_file(path).map(
        [](const std::string& bytes) { return base::Seed{}.stream(bytes).bits(0); });
}

/// Returns the identity of the playing program: this very build, and the algorithms that are not
/// built in. A session that another program has played is not reused. The error names an algorithm
/// whose file cannot be read.
base::Result<std::string> program_identity(const LoadedExperiment& experiment)
{
    std::string identity = fmt::format("{} {:016x}", base::version_line("hapnet-lab"),
                                       hash_of_file("/proc/self/exe").value_or(0));
    std::set<std::string> hashed;
    const auto add = [&](const experiment::Experiment& one) -> base::Result<void> {
        for (const experiment::NamedAlgorithm& named : one.algorithms) {
            const auto* const own = std::get_if<peer::SharedObject>(&named.algorithm);
            if (own == nullptr || !hashed.insert(own->options().file).second) continue;
            const auto hash = hash_of_file(own->options().file);
            if (!hash) return base::fail(fmt::format("{}: {}", named.name, hash.error().message));
            identity += fmt::format(" {:016x}", *hash);
        }
        return {};
    };
    auto added = add(experiment.whole);
    for (const LoadedExperiment::Part& part : experiment.parts) {
        if (added) added = add(part.experiment);
    }
    if (!added) return tl::unexpected{std::move(added).error()};
    return identity;
}

experiment::Overrides overrides_of(const RunCommand& command)
{
    experiment::Overrides overrides{command.quick, command.settings};
    if (command.seeds) overrides.settings.push_back(fmt::format("seeds={}", *command.seeds));
    return overrides;
}

/// Loads the experiment of a plan. `open` returns the texts of its files.
base::Result<LoadedExperiment> load(const Plan& plan, const base::OpenFile& open)
{
    auto whole = load_experiment(plan.experiment, open, plan.overrides);
    if (!whole) return tl::unexpected{whole.error()};
    auto points = load_axis_points(plan.experiment, open, plan.overrides);
    if (!points) return tl::unexpected{points.error()};
    const auto criteria = experiment::load_criteria(plan.criteria, open);
    if (!criteria) return tl::unexpected{criteria.error()};
    LoadedExperiment experiment{*std::move(whole), {}, *criteria, {}, 0};
    for (auto point = points->begin(); point != points->end(); ++point) {
        for (experiment::Experiment& part : parts_of(point->experiment)) {
            experiment.jobs += make_jobs(part).size();
            experiment.parts.push_back({static_cast<std::size_t>(point - points->begin()),
                                        point->values, std::move(part)});
        }
    }
    auto identity = program_identity(experiment);
    if (!identity) return tl::unexpected{identity.error()};
    experiment.program = *std::move(identity);
    return experiment;
}

/// Loads, and so runs, the code of algorithms that are not built in. Call it only when sessions
/// will be played.
base::Result<void> load_code(LoadedExperiment& experiment)
{
    auto loaded = load_own_algorithms(experiment.whole);
    for (LoadedExperiment::Part& part : experiment.parts) {
        if (loaded) loaded = load_own_algorithms(part.experiment);
    }
    return loaded;
}

std::string folder_of(const std::string& plan)
{
    const auto folder = std::filesystem::path{plan}.parent_path();
    return folder.empty() ? "." : folder.string();
}

unsigned thread_count(const std::optional<unsigned>& jobs)
{
    return jobs.value_or(std::max(std::thread::hardware_concurrency(), 1U));
}

Plan plan_of(const RunCommand& command)
{
    Plan plan;
    plan.experiment = command.experiment;
    plan.overrides = overrides_of(command);
    plan.criteria = command.criteria;
    return plan;
}

base::Result<int> run_plan(const RunCommand& command, const std::string& path)
{
    if (!command.settings.empty() || command.seeds || command.quick)
        return base::fail("a plan says it all: --set, --seeds and --quick go with hapnet-lab plan");
    auto experiment = load_plan(path);
    if (!experiment) return tl::unexpected{experiment.error()};
    if (auto loaded = load_code(*experiment); !loaded) return tl::unexpected{loaded.error()};
    const RunPlace place{command.out.empty() ? folder_of(path) : command.out,
                         thread_count(command.jobs), command.command};
    return command.shard ? run_shard(*experiment, *command.shard, place)
                         : run_whole(*experiment, place);
}

} // namespace

base::Result<LoadedExperiment> load_plan(const std::string& path)
{
    const auto plan = read_plan(path);
    if (!plan) return tl::unexpected{plan.error()};
    auto experiment = load(*plan, opener_of(*plan));
    if (experiment && experiment->program != plan->program) {
        return base::fail(fmt::format("{} was made by {}, and this is {}: plan again, or use the "
                                      "same build",
                                      path, plan->program, experiment->program));
    }
    return experiment;
}

base::Result<int> run_experiment(const RunCommand& command)
{
    if (const auto plan = plan_at(command.experiment); !plan.empty())
        return run_plan(command, plan);
    if (command.shard) return base::fail("--shard needs a plan: hapnet-lab plan writes one");
    if (command.out.empty()) return base::fail("--out is required: --out results/mine");
    auto experiment = load(plan_of(command), net::text_of_file);
    if (!experiment) return tl::unexpected{experiment.error()};
    if (auto loaded = load_code(*experiment); !loaded) return tl::unexpected{loaded.error()};
    return run_whole(*experiment, {command.out, thread_count(command.jobs), command.command});
}

base::Result<int> plan_experiment(const PlanCommand& planned)
{
    const RunCommand& command = planned.run;
    Plan plan = plan_of(command);
    const auto experiment = load(plan, opener_into(plan));
    if (!experiment) return tl::unexpected{experiment.error()};
    plan.program = experiment->program;
    create_folder(command.out);
    const auto path = (std::filesystem::path{command.out} / plan_name).string();
    write_plan(plan, path);
    net::print(fmt::format("{}: {} jobs in {} parts; {}\n", experiment->whole.title,
                           experiment->jobs, experiment->parts.size(), path));
    return 0;
}

base::Result<int> merge(const MergeCommand& command)
{
    const auto plan = plan_at(command.folders.front());
    if (plan.empty()) {
        return base::fail(fmt::format("{} has no {}: merge the folder that hapnet-lab plan wrote",
                                      command.folders.front(), plan_name));
    }
    auto experiment = load_plan(plan);
    if (!experiment) return tl::unexpected{experiment.error()};
    // Records are made by playing the sessions again.
    if (experiment->whole.record) {
        if (auto loaded = load_code(*experiment); !loaded) return tl::unexpected{loaded.error()};
    }
    auto folders = command.folders;
    folders.front() = folder_of(plan);
    return merge_shards(*experiment, folders,
                        {folders.front(), thread_count(command.jobs), command.command});
}

} // namespace hapnet::lab
