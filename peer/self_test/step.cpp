// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/step.hpp"

namespace hapnet::peer::self_test {

std::string_view describe(Prompt prompt)
{
    switch (prompt) {
    case Prompt::nothing: return "";
    case Prompt::hold_still: return "reading, without force: move it a little";
    case Prompt::wait: return device::describe(device::CalibrationStep::busy);
    case Prompt::dock: return device::describe(device::CalibrationStep::dock_stylus);
    case Prompt::sweep: return device::describe(device::CalibrationStep::sweep_joints);
    case Prompt::undock: return "take the stylus out of its holder";
    case Prompt::release_button: return "let go of the primary button first";
    case Prompt::hold_button:
        return "hold it loosely, then press the primary button and keep it down: 0.2 N will push "
               "to the right; let go of the button to stop it";
    case Prompt::keep_button: return "0.2 N to the right: keep the button down, or let go to stop";
    case Prompt::pull_cable: return "pull the device's cable, now";
    }
    return "";
}

} // namespace hapnet::peer::self_test
