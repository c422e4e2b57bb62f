// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "proto/base/visible.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <cstdio>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::emulator {

base::Result<int> run(const LearnOptions& options)
{
    const auto named = parse_columns(options.columns);
    if (!named) return base::fail(fmt::format("--columns: {}", named.error().message));
    std::vector<tools::MeasuredFile> files;
    for (const std::string& file : options.files) {
        auto bytes = net::text_of_file(file);
        if (!bytes) return tl::unexpected{bytes.error()};
        files.push_back({file, *std::move(bytes)});
    }
    auto measurement = tools::read_measurements(files, *named);
    if (!measurement) return tl::unexpected{measurement.error()};
    if (options.spacing) {
        for (auto* way : {&measurement->round_trip, &measurement->up, &measurement->down}) {
            if (*way) (*way)->spacing = options.spacing;
        }
    }
    const auto lesson = tools::learn(*measurement);
    if (!lesson) {
        return base::fail(fmt::format("{}: {}", options.files.front(), lesson.error().message));
    }
    if (options.with_plots || isatty(STDERR_FILENO) != 0) {
        for (const std::string& plot : lesson->plots) net::tell(base::visible_lines(plot) + "\n");
    }
    for (const std::string& remark : lesson->remarks) net::tell(base::visible_lines(remark) + "\n");
    net::print(tools::to_text(*lesson));
    return 0;
}

} // namespace hapnet::emulator
