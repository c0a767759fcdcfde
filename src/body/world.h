#pragma once
/// Every body of a scene, advanced together.

#include <string>
#include <vector>

#include "body/body.h"

namespace furrow {

class World {
 public:
  /// The body is not owned; it must outlive the world or be removed.
  void add(Body& body, const std::string& name) { members_.push_back({&body, name}); }
  void remove(const Body& body);

  /// Advances every body by an interval [s] in equal sub-steps no longer than the smallest stable step of any body now;
  /// surface forces are held over the interval. Returns the number of sub-steps.
  /// @throws StateError naming the body when its stable step vanishes, its state is not finite or its own advance() refuses
  int advance(double interval);

 private:
  struct Member {
    Body* body;
    std::string name;
  };
  std::vector<Member> members_;
};

}  // namespace furrow
