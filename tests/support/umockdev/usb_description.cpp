// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/umockdev/usb_description.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::umockdev {

namespace {

constexpr std::uint8_t device_type = 1;
constexpr std::uint8_t configuration_type = 2;
constexpr std::uint8_t string_type = 3;
constexpr std::uint8_t interface_type = 4;
constexpr std::uint8_t endpoint_type = 5;
constexpr std::uint8_t bulk = 2;

std::uint8_t low(std::uint16_t value) { return static_cast<std::uint8_t>(value & 0xffU); }
std::uint8_t high(std::uint16_t value) { return static_cast<std::uint8_t>(value >> 8U); }

/// The index of a string, or 0 where there is none.
std::uint8_t index_of(const std::string& text, std::uint8_t index)
{
    return text.empty() ? std::uint8_t{0} : index;
}

std::string hex_of(const std::vector<std::byte>& bytes)
{
    std::string text;
    for (const std::byte byte : bytes) text += fmt::format("{:02X}", std::to_integer<int>(byte));
    return text;
}

} // namespace

std::string node_of(const UsbDescription& usb)
{
    return fmt::format("/dev/bus/usb/{:03}/{:03}", usb.bus, usb.address);
}

std::string path_of(const UsbDescription& usb)
{
    return fmt::format("/sys/devices/usb{}/{}-{}", usb.bus, usb.bus, usb.address);
}

std::vector<std::byte> descriptors_of(const UsbDescription& usb)
{
    // USB 2.0, tables 9-8, 9-10, 9-12 and 9-13: full speed, packets of 64 bytes, 90 mA.
    const std::vector<std::uint8_t> numbers{18,
                                            device_type,
                                            0x00,
                                            0x02,
                                            0,
                                            0,
                                            0,
                                            64,
                                            low(usb.vendor),
                                            high(usb.vendor),
                                            low(usb.product),
                                            high(usb.product),
                                            0x00,
                                            0x04,
                                            index_of(usb.vendor_name, 1),
                                            index_of(usb.product_name, 2),
                                            index_of(usb.serial, 3),
                                            1,
                                            9,
                                            configuration_type,
                                            32,
                                            0,
                                            1,
                                            1,
                                            0,
                                            0xa0,
                                            45,
                                            9,
                                            interface_type,
                                            0,
                                            0,
                                            2,
                                            0xff,
                                            0xff,
                                            0xff,
                                            0,
                                            7,
                                            endpoint_type,
                                            usb.endpoint_in,
                                            bulk,
                                            64,
                                            0,
                                            0,
                                            7,
                                            endpoint_type,
                                            usb.endpoint_out,
                                            bulk,
                                            64,
                                            0,
                                            0};
    std::vector<std::byte> bytes;
    for (const std::uint8_t number : numbers) bytes.push_back(std::byte{number});
    return bytes;
}

std::vector<std::byte> string_descriptor_of(const UsbDescription& usb, std::uint8_t index)
{
    std::vector<std::byte> bytes{std::byte{0}, std::byte{string_type}};
    if (index == 0) {
        bytes.insert(bytes.end(), {std::byte{0x09}, std::byte{0x04}}); // English
    } else {
        const std::string& text = index == 1   ? usb.vendor_name
                                  : index == 2 ? usb.product_name
                                               : usb.serial;
        if (index > 3 || text.empty()) return {};
        for (const char letter : text) {
            bytes.insert(bytes.end(), {static_cast<std::byte>(letter), std::byte{0}});
        }
    }
    bytes.front() = static_cast<std::byte>(bytes.size());
    return bytes;
}

std::string testbed_text_of(const UsbDescription& usb)
{
    const std::string descriptors = hex_of(descriptors_of(usb));
    std::string text = fmt::format("P: /devices/usb{0}/{0}-{1}\n"
                                   "N: bus/usb/{0:03}/{1:03}={2}\n"
                                   "E: DEVNAME=/dev/bus/usb/{0:03}/{1:03}\n"
                                   "E: DEVTYPE=usb_device\n"
                                   "E: SUBSYSTEM=usb\n"
                                   "E: BUSNUM={0:03}\n"
                                   "E: DEVNUM={1:03}\n"
                                   "A: busnum={0}\\n\n"
                                   "A: devnum={1}\\n\n"
                                   "A: speed=12\\n\n"
                                   "A: bConfigurationValue=1\\n\n"
                                   "A: idVendor={3:04x}\\n\n"
                                   "A: idProduct={4:04x}\\n\n",
                                   usb.bus, usb.address, descriptors, usb.vendor, usb.product);
    const auto add_name = [&](std::string_view attribute, const std::string& name) {
        if (!name.empty()) text += fmt::format("A: {}={}\\n\n", attribute, name);
    };
    add_name("manufacturer", usb.vendor_name);
    add_name("product", usb.product_name);
    add_name("serial", usb.serial);
    return text + fmt::format("H: descriptors={}\n", descriptors);
}

} // namespace hapnet::umockdev
