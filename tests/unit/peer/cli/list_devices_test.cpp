// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/list_devices.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

TEST(DeviceTable, SaysWhatToDoWhenNoDeviceIsFound)
{
    EXPECT_TRUE(device_table({}).starts_with("No haptic device found. Run hapnet-peer doctor"));
}

TEST(DeviceTable, CarriesTheNoteOfEachDevice)
{
    const device::Found falcon{{.backend = "falcon",
                                .serial = "7",
                                .model = "Novint Falcon",
                                .note = std::string{device::never_run}},
                               {}};
    const std::string table = device_table({falcon});
    EXPECT_NE(table.find("falcon:7"), std::string::npos) << table;
    EXPECT_NE(table.find("Novint Falcon (never run on the physical device)"), std::string::npos);
}

} // namespace
} // namespace hapnet::peer
