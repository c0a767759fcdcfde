// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/node_exchange.h"

#include <algorithm>

namespace furrow {

namespace {

/// Layers of nodes across an axis, over the local nodes along the other one.
class Layers {
 public:
  Layers(int axis, Grid& grid, const Partition& partition)
      : axis_(axis),
        grid_(grid),
        partition_(partition),
        column_(4 * static_cast<std::size_t>(grid.nodes(2))),
        across_(partition.local_nodes(1 - axis, partition.own_block(1 - axis))) {}

  NodeRange local() const { return partition_.local_nodes(axis_, partition_.own_block(axis_)); }
  /// Nodes that another block has too; none of the own block.
  NodeRange shared(int block) const {
    if (block == partition_.own_block(axis_)) return {};
    const NodeRange mine = local(), theirs = partition_.local_nodes(axis_, block);
    return {std::max(mine.from, theirs.from), std::min(mine.to, theirs.to)};
  }
  /// Count of numbers of a layer in a field.
  std::size_t length() const { return column_ * static_cast<std::size_t>(across_.size()); }
  /// Count of numbers of all fields that are shared with another block.
  std::size_t shared_length(int block) const {
    return length() * static_cast<std::size_t>(grid_.fields() * shared(block).size());
  }
  /// Place of a layer among the numbers shared with a block.
  std::size_t place(int block, int layer, int field) const {
    const NodeRange range = shared(block);
    return length() * static_cast<std::size_t>(field * range.size() + layer - range.from);
  }
  /// Calls visit(first, count, where in the layer) for the numbers that lie together in memory.
  template <class Visit>
  void for_pieces(int layer, int field, Visit visit) {
    if (axis_ == 0)
      visit(grid_.column_sums(layer, across_.from, field), length(), std::size_t(0));
    else
      for (int i = across_.from; i < across_.to; ++i)
        visit(grid_.column_sums(i, layer, field), column_,
              column_ * static_cast<std::size_t>(i - across_.from));
  }
  void copy(int layer, int field, double* to) {
    for_pieces(layer, field, [&](const double* first, std::size_t count, std::size_t at) {
      std::copy_n(first, count, to + at);
    });
  }

 private:
  int axis_;
  Grid& grid_;
  const Partition& partition_;
  std::size_t column_;  // numbers of a column of nodes
  NodeRange across_;
};

}  // namespace

void NodeExchange::add_shared_sums(Grid& grid, const Partition& partition) {
  for (const int axis : {0, 1})
    if (partition.blocks(axis) > 1) add_along(axis, grid, partition);
}

/// All are sent before anything is added, then added in the order of the blocks: a node's sum has
/// the same bits on every rank.
void NodeExchange::add_along(int axis, Grid& grid, const Partition& partition) {
  pack(axis, grid, partition);
  std::vector<Communicator::Message>& messages = messages_[static_cast<std::size_t>(axis)];
  partition.ranks().exchange(messages);
  for (const Communicator::Message& message : messages) {
    if (message.sent.empty()) continue;
    traffic_.messages += 1.0;
    traffic_.bytes += static_cast<double>(sizeof(double) * message.sent.size());
  }
  add_received(axis, grid, partition);
}

void NodeExchange::pack(int axis, Grid& grid, const Partition& partition) {
  std::vector<Communicator::Message>& messages = messages_[static_cast<std::size_t>(axis)];
  messages.resize(static_cast<std::size_t>(partition.blocks(axis)));
  Layers layers(axis, grid, partition);
  for (int block = 0; block < partition.blocks(axis); ++block) {
    Communicator::Message& message = messages[static_cast<std::size_t>(block)];
    message.other = partition.rank_along(axis, block);
    message.sent.resize(layers.shared_length(block));
    message.received.resize(message.sent.size());
    const NodeRange shared = layers.shared(block);
    for (int field = 0; field < grid.fields(); ++field)
      for (int layer = shared.from; layer < shared.to; ++layer)
        layers.copy(layer, field, message.sent.data() + layers.place(block, layer, field));
  }
}

void NodeExchange::add_received(int axis, Grid& grid, const Partition& partition) {
  const std::vector<Communicator::Message>& messages = messages_[static_cast<std::size_t>(axis)];
  Layers layers(axis, grid, partition);
  own_.resize(layers.length());
  const NodeRange local = layers.local();
  for (int field = 0; field < grid.fields(); ++field)
    for (int layer = local.from; layer < local.to; ++layer) {
      parts_.clear();
      for (int block = 0; block < partition.blocks(axis); ++block)
        if (block == partition.own_block(axis))
          parts_.push_back(own_.data());
        else if (layers.shared(block).contains(layer))
          parts_.push_back(messages[static_cast<std::size_t>(block)].received.data() +
                           layers.place(block, layer, field));
      if (parts_.size() == 1) continue;
      layers.copy(layer, field, own_.data());
      layers.for_pieces(layer, field, [&](double* sum, std::size_t count, std::size_t at) {
        std::copy_n(parts_[0] + at, count, sum);
        for (std::size_t p = 1; p < parts_.size(); ++p)
          for (std::size_t n = 0; n < count; ++n) sum[n] += parts_[p][at + n];
      });
    }
}

HaloTraffic NodeExchange::all_traffic(const Communicator& ranks) const {
  double sums[] = {traffic_.steps, traffic_.messages, traffic_.bytes};
  ranks.sum(sums, 3);
  return {sums[0], sums[1], sums[2]};
}

HaloTraffic NodeExchange::mean_traffic(const Communicator& ranks) const {
  const HaloTraffic all = all_traffic(ranks);
  const double size = ranks.size();
  return {all.steps / size, all.messages / size, all.bytes / size};
}

void NodeExchange::checkpoint(Checkpoint& state, const Communicator& ranks) {
  HaloTraffic all = state.saving() ? all_traffic(ranks) : HaloTraffic{};
  state.value("rank_steps", all.steps);
  state.value("halo_messages", all.messages);
  state.value("halo_bytes", all.bytes);
  traffic_ = ranks.rank() == 0 ? all : HaloTraffic{};
}

}  // namespace furrow
