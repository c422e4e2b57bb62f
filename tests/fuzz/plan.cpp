// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/plan.hpp"

#include "lab/experiment/text.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/memory_file.hpp"

/// Any plan.json is a plan, or is refused with the name of the file. An experiment in a plan is
/// read or refused, with the plan's own files and no others.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const fuzz::MemoryFile file{fuzz::bytes_of(data, size)};
    const auto plan = lab::read_plan(file.path());
    if (!plan) {
        base::ensure(plan.error().message.find(file.path()) != std::string::npos);
        return 0;
    }
    const auto open = lab::opener_of(*plan);
    static_cast<void>(lab::experiment::load_experiment(plan->experiment, open, plan->overrides));
    return 0;
}
