// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/task_options.hpp"

#include "device/simulated/keys.hpp"

namespace hapnet::device {

namespace {

constexpr Range squeeze{base::force_kind, 0.0, 3.3};
constexpr Range aim{base::length_kind, 0.0, 0.02};
constexpr Range press_frequency{base::frequency_kind, 0.1, 10.0};
constexpr Plain path_pace{0.1, 2.0};
constexpr base::Duration lag_max{std::chrono::seconds{1}};

template <typename Keys, typename Options>
void list_task_keys(Keys& keys, Options& options)
{
    keys.value("squeeze", options.squeeze_n, squeeze);
    keys.value("press_depth", options.press_depth_m, aim);
    keys.value("press_amplitude", options.press_amplitude_m, aim);
    keys.value("press_frequency", options.press_hertz, press_frequency);
    keys.value("pace", options.pace, path_pace);
    keys.value("follower_lag", options.follower_lag, lag_max);
}

} // namespace

std::optional<TaskOptions> read_task_options(const base::Node& node, base::Reading& reading)
{
    TaskOptions options;
    const auto* entries = std::get_if<base::Node::Table>(&node.value);
    if (entries == nullptr) {
        base::complain_of(node, "a table of a task's options", reading);
        return std::nullopt;
    }
    base::TableReader table{*entries, node.place, reading};
    KeyReader keys{table};
    list_task_keys(keys, options);
    table.finish();
    if (!reading.is_good()) return std::nullopt;
    return options;
}

std::string print_task_options(const TaskOptions& options)
{
    KeyPrinter keys;
    list_task_keys(keys, options);
    return keys.text();
}

} // namespace hapnet::device
