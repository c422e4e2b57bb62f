// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hapnet::umockdev {

/// A USB device of one interface without a class and two bulk endpoints, as it describes itself.
struct UsbDescription {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string vendor_name{};   // "": it does not say
    std::string product_name{};  // likewise
    std::string serial{};        // likewise
    std::string kernel_driver{}; // that has hold of it from the start, such as "ftdi_sio"
    std::uint8_t endpoint_in = 0x81;
    std::uint8_t endpoint_out = 0x02;
    int bus = 1;
    int address = 2; // on the bus
};

/// Its node, such as "/dev/bus/usb/001/002".
[[nodiscard]] std::string node_of(const UsbDescription& usb);
/// Its folder in /sys.
[[nodiscard]] std::string path_of(const UsbDescription& usb);
/// Its device descriptor, with that of its one configuration behind it.
[[nodiscard]] std::vector<std::byte> descriptors_of(const UsbDescription& usb);
/// Its string `index`: 0 the languages, 1 the vendor's name, 2 the product's, 3 the serial number;
/// empty when there is none.
[[nodiscard]] std::vector<std::byte> string_descriptor_of(const UsbDescription& usb,
                                                          std::uint8_t index);
/// For Testbed::add().
[[nodiscard]] std::string testbed_text_of(const UsbDescription& usb);

} // namespace hapnet::umockdev
