// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <vector>

namespace hapnet::conformance {

/// The parts of the suite that apply to a backend. The suite skips the others by name.
struct Traits {
    bool has_motors = true;
    bool calibrates = false; // positions mean nothing until a person has helped
    bool docks = false;      // it knows whether its stylus rests in its holder
    bool stalls = true;      // its double can fall silent
    bool unplugs = true;
    bool garbles = true;   // its double can say nonsense
    bool exclusive = true; // a second opener is refused
};

/// A device without motors or hardware, such as a recorded hand.
inline constexpr Traits only_software{
    .has_motors = false, .stalls = false, .unplugs = false, .garbles = false, .exclusive = false};

/// A motor command as the double of the device understood it.
struct Command {
    bool zero = true; // no motor is asked for any torque
    bool motors_on = false;
};

/// A backend with the double of its device, as the suite needs them.
class Subject {
public:
    Subject() = default;
    virtual ~Subject() = default;
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    [[nodiscard]] virtual Traits traits() const = 0;
    /// Opens the device by the backend's own function, as the daemon does.
    [[nodiscard]] virtual device::Opened<std::unique_ptr<device::Device>> open() = 0;

    /// The device's time, virtual where the double allows that, and a function that lets it pass.
    [[nodiscard]] virtual base::TimePoint now() = 0;
    virtual void pass(base::Duration duration) = 0;

    // Events of the device. The suite calls each only where the traits allow it.
    virtual void help_calibrate() {} // the person does what the calibration asks for
    virtual void dock(bool /*in*/) {}
    virtual void press(bool /*down*/) {} // the primary button
    virtual void stall(bool /*on*/) {}
    virtual void unplug() {}
    virtual void plug_in() {} // again: open() works, to zero force
    virtual void garble(bool /*on*/) {}

    /// All motor commands that have reached the double since it was made, in their order.
    [[nodiscard]] virtual std::vector<Command> commands() const = 0;
};

/// Makes the subject. Each backend's test program defines its own.
[[nodiscard]] std::unique_ptr<Subject> make_subject();

} // namespace hapnet::conformance
