// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/exercise.hpp"

#include <string_view>

namespace hapnet::lab {

Exercise exercise_of(device::Task task)
{
    const std::string_view name = device::name_of(task);
    if (name == "P1" || name == "T1") return {.by_turns = true, .along_path = true};
    if (name == "T2") return {.contact = {1.0, 27.0}};
    if (name == "T3") {
        return {.along_path = true, .path_pace = 0.5, .contact = {1.0, 27.0}};
    }
    if (name == "T4") return {.contact = {2.0, 27.0}, .lifts = true};
    if (name == "T5") return {.contact = {2.0, 15.0}};
    if (name == "T6") return {.by_turns = true};
    return {};
}

} // namespace hapnet::lab
