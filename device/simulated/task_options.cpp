// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/task_options.hpp"

namespace hapnet::device {

std::optional<TaskOptions> read_task_options(const base::Node& node, base::Reading& reading)
{
    TaskOptions options;
    base::read_table(node, options, reading);
    if (!reading.is_good()) return std::nullopt;
    return options;
}

std::string print_task_options(const TaskOptions& options) { return base::field_lines(options); }

} // namespace hapnet::device
