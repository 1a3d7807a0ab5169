#include "system/named.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(NamedSystems, HoldThePapersCodesToTheBit) {
  std::ifstream file(CODES);
  const auto codes = nlohmann::json::parse(file)["systems"];
  ASSERT_EQ(codes.size(), 15u);
  for (const auto& code : codes) {
    const auto name = code["name"].get<std::string>();
    const auto system = named_system(name);
    ASSERT_EQ(system->maps().size(), code["maps"].size()) << name;
    for (std::size_t i = 0; i < system->maps().size(); ++i) {
      const auto& m = code["maps"][i];
      EXPECT_EQ(system->maps()[i], plane(m["a"], m["b"], m["c"], m["d"], m["e"], m["f"])) << name << " " << i;
      if (m.contains("p"))
        EXPECT_EQ(system->weights()[i], m["p"].get<double>()) << name << " " << i;
      else
        EXPECT_TRUE(system->weights().empty()) << name;
    }
  }
}

TEST(NamedSystems, HaveEachANameASourceAndAnAttractor) {
  std::set<std::string_view> names;
  for (const NamedSystem& each : named_systems()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_FALSE(each.source.empty()) << each.name;
    const auto system = named_system(each.name);
    EXPECT_EQ(system->dimension(), each.dimension) << each.name;
    EXPECT_NO_THROW(static_cast<void>(system->enclosure())) << each.name;
    for (const Affine& map : system->maps())
      if (each.dimension == 2) {
        EXPECT_TRUE(map.linear.row(2).isZero(0) && map.linear.col(2).isZero(0) && map.shift(2) == 0) << each.name;
      }
  }
  EXPECT_GE(names.size(), 30u);
}

TEST(NamedSystems, AreFoundByAliasesAndWithHyphens) {
  EXPECT_EQ(*named_system("fern"), *named_system("fern_barnsley"));
  EXPECT_EQ(*named_system("twin-dragon"), *named_system("twin_dragon"));
}

TEST(NamedSystems, AreListedWhenANameIsNone) {
  try {
    named_system("frn");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.argument(), "name");
    EXPECT_NE(std::string(error.what()).find("fern_barnsley"), std::string::npos);
  }
}

TEST(NamedSystems, SuggestTheNameThatWasMeant) {
  const auto says = [](const std::string& name) -> std::string {
    try {
      static_cast<void>(named_system(name));
    } catch (const Error& error) {
      EXPECT_EQ(error.argument(), "name");
      return error.what();
    }
    return "";
  };
  const auto holds = [&](const std::string& name, const std::string& text) {
    return says(name).find(text) != std::string::npos;
  };
  EXPECT_TRUE(holds("frn", "Did you mean fern?"));
  EXPECT_TRUE(holds("fren", "Did you mean fern?"));
  EXPECT_TRUE(holds("menger-spong", "Did you mean menger_sponge?"));
  EXPECT_TRUE(holds("vicsekk", "Did you mean vicsek?"));
  for (const std::string& name : {std::string("qqqqqqqq"), std::string("x"), std::string(5000, 'f')})
    EXPECT_FALSE(holds(name, "Did you mean")) << name.substr(0, 20);
}

}  // namespace
