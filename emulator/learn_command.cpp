// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "proto/net/text_file.hpp"

#include <cstdio>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<int> run(const LearnOptions& options)
{
    const auto named = parse_columns(options.columns);
    if (!named) return base::fail(fmt::format("--columns: {}", named.error().message));
    const auto text = net::text_of_file(options.file);
    if (!text) return tl::unexpected{text.error()};
    auto measurement = tools::read_measurement(*text, *named);
    if (!measurement) {
        return base::fail(fmt::format("{}: {}", options.file, measurement.error().message));
    }
    if (options.spacing) measurement->spacing = options.spacing;
    const auto lesson = tools::learn(*measurement);
    if (!lesson) return base::fail(fmt::format("{}: {}", options.file, lesson.error().message));
    for (const std::string& remark : lesson->remarks) fmt::print(stderr, "{}\n", remark);
    fmt::print("{}", tools::to_text(*lesson));
    return 0;
}

} // namespace hapnet::emulator
