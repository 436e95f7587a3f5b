#include "lod/tree.h"

#include "core/check.h"
#include "core/error.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <deque>
#include <memory>

namespace gnomon::lod {
namespace {

float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) > value ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

float roundedUp(double value) {
    return -roundedDown(-value);
}

/// Returns a sphere that contains the spheres `a` and `b`.
Sphere merged(const Sphere& a, const Sphere& b) {
    const glm::dvec3 between = b.center - a.center;
    const double length = glm::length(between);
    if (length + b.radius <= a.radius) return a;
    if (length + a.radius <= b.radius) return b;
    const double radius = 0.5 * (length + a.radius + b.radius);
    return {a.center + between * ((radius - a.radius) / length), radius * (1 + 1e-12)};
}

/// A node during Embree's construction of the tree, with either children or an item.
struct BuildNode {
    std::vector<BuildNode*> children;
    std::uint32_t item = 0;
};

struct BuildContext {
    // Embree builds with one thread, so the container needs no locks. A deque never moves its elements.
    std::deque<BuildNode> nodes;
};

void* createNode(RTCThreadLocalAllocator /*allocator*/, unsigned childCount, void* user) {
    auto& node = static_cast<BuildContext*>(user)->nodes.emplace_back();
    node.children.resize(childCount);
    return &node;
}

void setChildren(void* node, void** children, unsigned childCount, void* /*user*/) {
    for (unsigned i = 0; i < childCount; ++i)
        static_cast<BuildNode*>(node)->children[i] = static_cast<BuildNode*>(children[i]);
}

void setBounds(void* /*node*/, const RTCBounds** /*bounds*/, unsigned /*childCount*/, void* /*user*/) {}

void* createLeaf(RTCThreadLocalAllocator /*allocator*/, const RTCBuildPrimitive* items, std::size_t count, void* user) {
    GNOMON_CHECK_OP(count, ==, std::size_t{1});
    auto& node = static_cast<BuildContext*>(user)->nodes.emplace_back();
    node.item = items->primID;
    return &node;
}

std::vector<RTCBuildPrimitive> primitives(std::span<const Item> items) {
    std::vector<RTCBuildPrimitive> result(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        RTCBuildPrimitive& p = result[i];
        const Box& box = items[i].box;
        p = {};
        p.lower_x = roundedDown(box.min.x);
        p.lower_y = roundedDown(box.min.y);
        p.lower_z = roundedDown(box.min.z);
        p.upper_x = roundedUp(box.max.x);
        p.upper_y = roundedUp(box.max.y);
        p.upper_z = roundedUp(box.max.z);
        p.primID = static_cast<unsigned>(i);
    }
    return result;
}

const BuildNode* embreeTree(std::span<const Item> items, BuildContext& context) {
    const std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device(rtcNewDevice("threads=1"), rtcReleaseDevice);
    if (!device) throw Error("bounding volume tree: cannot create an Embree device");
    const std::unique_ptr<RTCBVHTy, void (*)(RTCBVH)> bvh(rtcNewBVH(device.get()), rtcReleaseBVH);
    std::vector<RTCBuildPrimitive> boxes = primitives(items);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = kWidth;
    arguments.maxLeafSize = 1;
    arguments.minLeafSize = 1;
    arguments.bvh = bvh.get();
    arguments.primitives = boxes.data();
    arguments.primitiveCount = boxes.size();
    arguments.primitiveArrayCapacity = boxes.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.userPtr = &context;
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr)
        throw Error("bounding volume tree: Embree error " + std::to_string(rtcGetDeviceError(device.get())));
    return root;
}

/// Converts Embree's tree to an array of Node. Children come after their parents, and leaves are numbered from left to
/// right.
class Flattener {
public:
    Flattener(std::span<const Item> items, std::vector<Node>& nodes, std::vector<std::uint32_t>& order)
        : items_(items), nodes_(nodes), order_(order) {}

    Item add(const BuildNode& source) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        GNOMON_CHECK_OP(source.children.size(), <=, kWidth);
        Item total{{}, {}, 0};
        for (std::size_t lane = 0; lane < source.children.size(); ++lane) {
            const BuildNode& child = *source.children[lane];
            const bool isLeaf = child.children.empty();
            const std::uint32_t reference = isLeaf ? child.item : static_cast<std::uint32_t>(nodes_.size());
            if (isLeaf) order_.push_back(child.item);
            const Item item = isLeaf ? items_[child.item] : add(child);
            setLane(nodes_[index], lane, item, reference, isLeaf);
            total.box.add(item.box);
            total.bounds = lane == 0 ? item.bounds : merged(total.bounds, item.bounds);
            total.error = std::max(total.error, item.error);
        }
        return total;
    }

private:
    static void setLane(Node& node, std::size_t lane, const Item& item, std::uint32_t reference, bool isLeaf) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            node.min[a][lane] = roundedDown(item.box.min[axis]);
            node.max[a][lane] = roundedUp(item.box.max[axis]);
            node.bounds[a][lane] = static_cast<float>(item.bounds.center[axis]);
        }
        const glm::dvec3 moved(node.bounds[0][lane], node.bounds[1][lane], node.bounds[2][lane]);
        node.bounds[3][lane] = roundedUp((item.bounds.radius + glm::distance(moved, item.bounds.center)) * (1 + 1e-12));
        node.error[lane] = roundedUp(item.error);
        node.child[lane] = reference;
        node.count = static_cast<std::uint8_t>(lane + 1);
        if (isLeaf) node.leaves = static_cast<std::uint8_t>(node.leaves | (1U << lane));
    }

    std::span<const Item> items_;
    std::vector<Node>& nodes_;
    std::vector<std::uint32_t>& order_;
};

} // namespace

Tree::Tree(std::span<const Item> items) {
    if (items.empty()) return;
    for (const Item& item : items) {
        GNOMON_CHECK(!item.box.isEmpty());
        const glm::dvec3 far = glm::max(glm::abs(item.box.min), glm::abs(item.box.max));
        reach_ = std::max({reach_, far.x, far.y, far.z});
    }
    BuildContext context;
    const BuildNode* root = embreeTree(items, context);
    BuildNode onlyRoot; // for one item, Embree returns a leaf without a node
    if (root->children.empty()) {
        onlyRoot.children.push_back(const_cast<BuildNode*>(root));
        root = &onlyRoot;
    }
    Flattener(items, nodes_, order_).add(*root);
}

} // namespace gnomon::lod
