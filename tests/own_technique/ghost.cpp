// A technique of somebody's own, in one file and one line: nothing is in its way. The command runs it as any other.
#include <paperproof/techniques.hpp>

namespace {

using namespace paperproof;

class Ghost final : public Technique {
 public:
  Ghost(const TechniqueDef& def, const Scenery&, const CharacterDef&) {
    if (const auto turned = def.own.find("share"); turned != def.own.end()) share_ = real_in(turned->second);
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "ghost"; }
  [[nodiscard]] Scratch make_scratch() const override { return {}; }

  void move(const MoveRequest& request, Scratch&, MoveResult& result) const noexcept override {
    result.clear();
    result.position = request.position + request.displacement * share_;
    result.velocity = request.velocity;
    result.path.push_back({request.position, 0});
    result.path.push_back({result.position, 1});
  }

 private:
  double share_ = 1;  ///< Share of what is wanted that it goes.
};

const bool is_known = register_technique(
    entry_of<Ghost>("ghost", {{"share", "share of the wanted way that it goes; 1 where not turned",
                               [](const std::string& value, TechniqueDef& def) { def.own["share"] = value; }}}));

}  // namespace
