// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/interface.hpp"

#include "proto/base/ensure.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <linux/ethtool.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <linux/sockios.h>
#include <linux/veth.h>
#include <net/if.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

/// A descriptor that closes itself.
class Descriptor {
public:
    Descriptor(int number, const char* what) : number_{number}
    {
        if (number < 0) throw std::system_error{errno, std::generic_category(), what};
    }
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

/// A request of rtnetlink: a header, a fixed part, and attributes, some of them nested.
class NetlinkRequest {
public:
    template <typename Fixed>
    NetlinkRequest(std::uint16_t type, std::uint16_t flags, const Fixed& fixed)
    {
        header_.nlmsg_type = type;
        header_.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | NLM_F_ACK | flags);
        length_ = NLMSG_HDRLEN;
        append(fixed);
    }

    template <typename T>
    void append(const T& value)
    {
        append(std::as_bytes(std::span{&value, 1}));
    }
    void attribute(std::uint16_t type, std::span<const std::byte> value)
    {
        const rtattr head{static_cast<std::uint16_t>(RTA_LENGTH(value.size())), type};
        append(head);
        append(value);
    }
    void attribute(std::uint16_t type, const std::string& text) // with a terminating zero
    {
        attribute(type, std::as_bytes(std::span{text.c_str(), text.size() + 1}));
    }
    void attribute(std::uint16_t type, std::uint32_t value)
    {
        attribute(type, std::as_bytes(std::span{&value, 1}));
    }
    [[nodiscard]] std::size_t begin(std::uint16_t type)
    {
        const auto at = length_;
        append(rtattr{0, type});
        return at;
    }
    void end(std::size_t at)
    {
        const auto length = static_cast<std::uint16_t>(length_ - at);
        std::memcpy(&bytes_[at], &length, sizeof length);
    }

    /// Sends the request and waits for the answer. Returns 0 or an errno.
    [[nodiscard]] int ask()
    {
        const Descriptor socket{::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE),
                                "cannot ask the kernel for its network"};
        header_.nlmsg_len = static_cast<std::uint32_t>(length_);
        std::memcpy(bytes_.data(), &header_, sizeof header_);
        if (send(socket.number(), bytes_.data(), length_, 0) < 0) return errno;
        std::array<std::byte, 4096> answer{};
        const auto count = recv(socket.number(), answer.data(), answer.size(), 0);
        if (count < static_cast<ssize_t>(NLMSG_LENGTH(sizeof(nlmsgerr)))) return EPROTO;
        nlmsgerr said{};
        std::memcpy(&said, &answer[NLMSG_HDRLEN], sizeof said);
        return -said.error;
    }

private:
    void append(std::span<const std::byte> value)
    {
        const auto padded = NLMSG_ALIGN(value.size());
        base::ensure(length_ + padded <= bytes_.size());
        if (!value.empty()) std::memcpy(&bytes_[length_], value.data(), value.size());
        length_ += padded;
    }

    nlmsghdr header_{};
    std::array<std::byte, 1024> bytes_{};
    std::size_t length_ = 0;
};

void require(int error, const std::string& what)
{
    if (error != 0) throw std::system_error{error, std::generic_category(), what};
}

unsigned index_of(const std::string& interface)
{
    const unsigned index = if_nametoindex(interface.c_str());
    if (index == 0) require(ENODEV, fmt::format("there is no interface {}", interface));
    return index;
}

/// The 4 or 16 bytes of an address.
struct IpBytes {
    std::uint8_t family = AF_INET;
    std::array<std::byte, 16> bytes{};
    [[nodiscard]] std::span<const std::byte> used() const
    {
        return std::span{bytes}.first(family == AF_INET ? 4 : 16);
    }
};

IpBytes ip_bytes_of(const std::string& address)
{
    IpBytes ip{.family = address.find(':') == std::string::npos ? std::uint8_t{AF_INET}
                                                                : std::uint8_t{AF_INET6}};
    base::ensure(inet_pton(ip.family, address.c_str(), ip.bytes.data()) == 1);
    return ip;
}

ifreq request_for(const std::string& interface)
{
    base::ensure(interface.size() < IFNAMSIZ);
    ifreq request{};
    std::memcpy(&request.ifr_name, interface.c_str(), interface.size() + 1);
    return request;
}

Descriptor any_socket() { return {socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "socket"}; }

constexpr auto lro_flag = static_cast<std::uint32_t>(ETH_FLAG_LRO);

/// Reads or sets a value. Returns 0 or an errno.
int ethtool(const std::string& interface, ethtool_value& value)
{
    const auto socket = any_socket();
    ifreq request = request_for(interface);
    request.ifr_data = reinterpret_cast<char*>(&value);
    return ioctl(socket.number(), SIOCETHTOOL, &request) == 0 ? 0 : errno;
}

int set_ethtool(const std::string& interface, std::uint32_t command, std::uint32_t to)
{
    ethtool_value value{command, to};
    return ethtool(interface, value);
}

std::uint32_t ethtool_of(const std::string& interface, std::uint32_t command)
{
    ethtool_value value{command, 0};
    return ethtool(interface, value) == 0 ? value.data : 0;
}

} // namespace

std::size_t mtu_of(const std::string& interface)
{
    const auto socket = any_socket();
    ifreq request = request_for(interface);
    if (ioctl(socket.number(), SIOCGIFMTU, &request) != 0) {
        require(errno, fmt::format("cannot use the interface {}", interface));
    }
    return static_cast<std::size_t>(request.ifr_mtu);
}

bool has_interface(const std::string& interface) { return if_nametoindex(interface.c_str()) != 0; }

void make_veth(const std::string& here, const std::string& there, pid_t process_there,
               std::span<const std::byte> machine_there)
{
    NetlinkRequest request{RTM_NEWLINK, NLM_F_CREATE | NLM_F_EXCL, ifinfomsg{}};
    request.attribute(IFLA_IFNAME, here);
    const auto info = request.begin(IFLA_LINKINFO);
    request.attribute(IFLA_INFO_KIND, std::string{"veth"});
    const auto data = request.begin(IFLA_INFO_DATA);
    const auto peer = request.begin(VETH_INFO_PEER);
    request.append(ifinfomsg{});
    request.attribute(IFLA_IFNAME, there);
    request.attribute(IFLA_NET_NS_PID, static_cast<std::uint32_t>(process_there));
    if (!machine_there.empty()) request.attribute(IFLA_ADDRESS, machine_there);
    request.end(peer);
    request.end(data);
    request.end(info);
    require(request.ask(), fmt::format("cannot make the interface {}", here));
}

void set_up(const std::string& interface)
{
    ifinfomsg link{};
    link.ifi_index = static_cast<int>(index_of(interface));
    link.ifi_flags = IFF_UP;
    link.ifi_change = IFF_UP;
    require(NetlinkRequest{RTM_NEWLINK, 0, link}.ask(),
            fmt::format("cannot start the interface {}", interface));
}

void add_address(const std::string& interface, const std::string& address, std::uint8_t bits)
{
    const auto ip = ip_bytes_of(address);
    ifaddrmsg message{};
    message.ifa_family = ip.family;
    message.ifa_prefixlen = bits;
    message.ifa_flags = IFA_F_NODAD;
    message.ifa_index = index_of(interface);
    NetlinkRequest request{RTM_NEWADDR, NLM_F_CREATE | NLM_F_EXCL, message};
    request.attribute(IFA_LOCAL, ip.used());
    request.attribute(IFA_ADDRESS, ip.used());
    require(request.ask(), fmt::format("cannot give {} the address {}", interface, address));
}

void add_group_routes(const std::string& interface)
{
    for (const auto& [address, bits] : {std::pair{"224.0.0.0", 4}, {"255.255.255.255", 32}}) {
        const auto ip = ip_bytes_of(address);
        rtmsg message{};
        message.rtm_family = AF_INET;
        message.rtm_dst_len = static_cast<unsigned char>(bits);
        message.rtm_table = RT_TABLE_MAIN;
        message.rtm_protocol = RTPROT_STATIC;
        message.rtm_scope = RT_SCOPE_LINK;
        message.rtm_type = RTN_UNICAST;
        NetlinkRequest request{RTM_NEWROUTE, NLM_F_CREATE | NLM_F_EXCL, message};
        request.attribute(RTA_DST, ip.used());
        request.attribute(RTA_OIF, static_cast<std::uint32_t>(index_of(interface)));
        require(request.ask(), fmt::format("cannot route {}/{} by {}", address, bits, interface));
    }
}

void add_default_route(const std::string& interface, const std::string& router)
{
    const auto ip = ip_bytes_of(router);
    rtmsg message{};
    message.rtm_family = ip.family;
    message.rtm_table = RT_TABLE_MAIN;
    message.rtm_protocol = RTPROT_STATIC;
    message.rtm_scope = RT_SCOPE_UNIVERSE;
    message.rtm_type = RTN_UNICAST;
    NetlinkRequest request{RTM_NEWROUTE, NLM_F_CREATE | NLM_F_EXCL, message};
    request.attribute(RTA_GATEWAY, ip.used());
    request.attribute(RTA_OIF, static_cast<std::uint32_t>(index_of(interface)));
    require(request.ask(), fmt::format("cannot route by {}", router));
}

void ignore_router_advertisements(const std::string& interface)
{
    std::ofstream{fmt::format("/proc/sys/net/ipv6/conf/{}/accept_ra", interface)} << "0";
}

void switch_off_offloads(const std::string& interface)
{
    // The order matters: once checksums are no longer left to the device, the kernel itself splits
    // the packets that still need it.
    for (const int command : {ETHTOOL_STSO, ETHTOOL_SGRO, ETHTOOL_SRXCSUM, ETHTOOL_STXCSUM}) {
        set_ethtool(interface, static_cast<std::uint32_t>(command), 0);
    }
    set_receive_offloads(interface, 0);
}

std::uint32_t receive_offloads_of(const std::string& interface)
{
    return std::uint32_t{ethtool_of(interface, ETHTOOL_GGRO) != 0} |
           (ethtool_of(interface, ETHTOOL_GFLAGS) & lro_flag);
}

void set_receive_offloads(const std::string& interface, std::uint32_t offloads)
{
    set_ethtool(interface, ETHTOOL_SGRO, offloads & 1U);
    const auto flags = ethtool_of(interface, ETHTOOL_GFLAGS);
    const auto wanted = (flags & ~lro_flag) | (offloads & lro_flag);
    if (wanted != flags) set_ethtool(interface, ETHTOOL_SFLAGS, wanted);
}

} // namespace hapnet::net
