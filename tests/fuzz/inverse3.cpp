// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/inverse3/messages.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>

/// Whatever a service says, accepted values are finite and bounded, and its identities can be sent
/// back in a message that asks for nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    using namespace device::inverse3;
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    const auto state = parse_state(text);
    if (!state) {
        base::ensure(!state.error().message.empty());
        return 0;
    }
    base::ensure(state->devices.size() <= devices_max);
    for (const DeviceState& device : state->devices) {
        base::ensure(base::is_finite(device.hip) && base::is_finite(device.velocity));
        base::ensure(!device.id.empty() && device.id.size() <= id_bytes_max);
        base::ensure(state->find(device.id) != nullptr);
        const auto report = report_of(&device, state->buttons);
        base::ensure(base::is_finite(report.hip) && base::is_finite(report.velocity));
        const std::string told = force_message(device.id, {{{0.5, -0.25, 1.0}}, true});
        base::ensure(std::count(told.begin(), told.end(), '"') == 18);
        base::ensure(told.find("\"device_id\":\"" + device.id + "\"") != std::string::npos);
    }
    return 0;
}
