// The rows of the bad-input table that are about materials: what they are, where they are, and the tables of media.
#include "program.h"
#include "table.h"

namespace raytube::testing {
namespace {

const std::string all_glass =
    "[target]\nmesh = \"mesh.off\"\nunit = \"mm\"\nmaterial = \"glass\"\n" + frequency + look + "[materials.glass]\n";

// A case in which everything is made of glass, which these keys define.
BadRow glass(const std::string& name, const std::string& keys, const std::string& says) {
  return with_file("glass_" + name, "bad.toml", all_glass + keys, "run bad.toml", says);
}

std::vector<BadRow> material_rows() {
  const std::string half_space = "kind = \"dielectric\"\n", coat = "kind = \"coated\"\n", sheet = "kind = \"sheet\"\n",
                    convention = "in eps_r = eps' - j eps'' (e^{+jwt}) losses are not below 0; write ";
  return {
      glass("without_kind", "eps_r = 2\n",
            ", line 10: materials.glass.kind is missing; write \"pec\", \"absorber\", \"dielectric\""),
      glass("of_unknown_kind", "kind = \"metal\"\n", ", line 11: materials.glass.kind \"metal\" is unknown; write \"pec\""),
      glass("kind_is_a_number", "kind = 3\n", "materials.glass.kind must be a text in double quotes"),
      glass("with_unknown_key", half_space + "epsr = 2\n",
            ", line 12: unknown key \"materials.glass.epsr\"; did you mean \"materials.glass.eps_r\"?"),
      glass("without_medium", half_space, "materials.glass.eps_r is missing; add it, or table_csv or medium in its place"),
      glass("half_space_with_thickness", half_space + "eps_r = 2\nthickness_mm = 3\n",
            ", line 13: materials.glass.thickness_mm does not belong to kind \"dielectric\"; remove it, or write kind = "
            "\"coated\""),
      glass("half_space_with_layers", half_space + "layers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
            "materials.glass.layers does not belong to kind \"dielectric\"; remove it"),
      glass("conductor_with_medium", "kind = \"pec\"\neps_r = 2\n",
            "materials.glass.eps_r does not belong to kind \"pec\"; remove it"),
      glass("absorber_with_medium", "kind = \"absorber\"\nmedium = \"glass\"\n",
            "materials.glass.medium does not belong to kind \"absorber\"; remove it"),
      glass("coat_with_resistance", coat + "resistance_ohm = 100\n",
            "materials.glass.resistance_ohm does not belong to kind \"coated\"; remove it, or write kind = \"sheet\""),
      glass("coat_without_thickness", coat + "eps_r = 2\n", "materials.glass.thickness_mm is missing; add the thickness"),
      glass("thickness_zero", coat + "eps_r = 2\nthickness_mm = 0\n",
            ", line 13: materials.glass.thickness_mm must be from 1e-07 to 1e+15 (found 0)"),
      glass("thickness_negative", sheet + "eps_r = 2\nthickness_mm = -4\n",
            "thickness_mm must be from 1e-07 to 1e+15 (found -4)"),
      glass("thickness_endless", sheet + "eps_r = 2\nthickness_mm = inf\n", "thickness_mm must be a finite number"),
      glass("thickness_of_1e300", sheet + "eps_r = 2\nthickness_mm = 1e300\n", "thickness_mm must be from 1e-07 to 1e+15"),
      glass("thickness_of_1e_300", sheet + "eps_r = 2\nthickness_mm = 1e-300\n",
            "thickness_mm must be from 1e-07 to 1e+15 (found 1e-300)"),
      glass("roughness_of_1e300", "kind = \"pec\"\nroughness_rms_mm = 1e300\n",
            "materials.glass.roughness_rms_mm must be from 0 to 1e+06 (found 1e+300)"),
      glass("of_negative_permittivity", half_space + "eps_r = -1\n",
            ", line 12: materials.glass.eps_r: eps_r is below 0 at 10 GHz and has no loss, which no medium is; correct the sign, "
            "or "
            "write [real part, loss]"),
      glass("of_negative_permeability", half_space + "eps_r = 2\nmu_r = -3\n",
            "materials.glass.eps_r: mu_r is below 0 at 10 GHz and has no loss, which no medium is; correct the sign"),
      glass("medium_empty", half_space + "medium = \"\"\n", "materials.glass.medium \"\" is not in the library; write aluminium"),
      glass("layers_and_thickness", sheet + "thickness_mm = 2\nlayers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
            ", line 12: materials.glass.thickness_mm cannot be combined with layers; write it inside each layer"),
      glass("layers_and_medium", coat + "medium = \"glass\"\nlayers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
            "materials.glass.medium cannot be combined with layers; write it inside each layer"),
      glass("layers_none", coat + "layers = []\n", "materials.glass.layers must be a list of layers, for example"),
      glass("layers_a_table", coat + "layers = { thickness_mm = 1, eps_r = 2 }\n", "materials.glass.layers"),
      glass("layer_a_number", coat + "layers = [1, 2]\n", "materials.glass.layers[0] must be a layer, for example"),
      glass("layer_without_thickness", coat + "layers = [ { thickness_mm = 1, eps_r = 2 }, { eps_r = 2 } ]\n",
            "materials.glass.layers[1].thickness_mm is missing; add"),
      glass("layer_without_medium", coat + "layers = [ { thickness_mm = 1 } ]\n",
            "materials.glass.layers[0].eps_r is missing; add"),
      glass("layer_with_unknown_key", coat + "layers = [ { thickness = 1, eps_r = 2 } ]\n",
            "unknown key \"materials.glass.layers[0].thickness\"; did you mean \"materials.glass.layers[0].thickness_mm\"?"),
      glass("layer_with_roughness", coat + "layers = [ { thickness_mm = 1, eps_r = 2, roughness_rms_mm = 1 } ]\n",
            "unknown key \"materials.glass.layers[0].roughness_rms_mm\""),
      glass("resistance_and_thickness", sheet + "resistance_ohm = 10\nthickness_mm = 2\neps_r = 2\n",
            "materials.glass.thickness_mm cannot be combined with resistance_ohm; remove one of them"),
      glass("conductance_and_layers", sheet + "conductance_s = 10\nlayers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
            "materials.glass.layers cannot be combined with conductance_s; remove one of them"),
      glass("edges_unknown", half_space + "eps_r = 2\n[edges]\nmaterials = \"heuristic\"\n",
            ", line 14: edges.materials \"heuristic\" is unknown; write \"none\" or \"fringe\""),
      glass("edges_without_fringe", half_space + "eps_r = 2\n[edges]\nmethod = \"none\"\nmaterials = \"fringe\"\n",
            "edges.materials needs edges.method = \"fringe\"; remove it"),
      glass("incoherent_rays",
            half_space + "eps_r = 2\nroughness_rms_mm = 1\n[edges]\nmethod = \"utd\"\n[output]\nincoherent = true\n",
            "output.incoherent: incoherent power is not computed with edges.method = \"utd\"; remove one"),
      glass("incoherent_and_smooth", half_space + "eps_r = 2\n[output]\nincoherent = true\n",
            "output.incoherent: no surface is rough; give roughness_rms_mm to a material of the target"),
      glass("resistance_negative", sheet + "resistance_ohm = -1\n",
            "materials.glass.resistance_ohm must be at least 0 (found -1)"),
      glass("conductance_nan", sheet + "conductance_s = nan\n", "materials.glass.conductance_s must be a finite number"),
      glass("roughness_negative", "kind = \"pec\"\nroughness_rms_mm = -0.1\n",
            "materials.glass.roughness_rms_mm must be from 0 to 1e+06 (found -0.1)"),
      glass("permittivity_of_gain", half_space + "eps_r = [4, -0.1]\n",
            ", line 12: materials.glass.eps_r has a gain: " + convention + "[4, 0.1]"),
      glass("permeability_of_gain", half_space + "eps_r = 2\nmu_r = [1, -2]\n",
            ", line 13: materials.glass.mu_r has a gain: in mu_r = mu' - j mu'' (e^{+jwt}) losses are not below 0; write [1, 2]"),
      glass("loss_tangent_negative", half_space + "eps_r = 2\nloss_tangent = -0.01\n",
            "materials.glass.loss_tangent is a gain (found -0.01): " + convention + "0.01"),
      glass("conductivity_negative", half_space + "eps_r = 1\nconductivity_s_per_m = -5.8e7\n",
            "materials.glass.conductivity_s_per_m is a gain (found -58000000): " + convention + "58000000"),
      glass("loss_tangent_of_negative_permittivity", half_space + "eps_r = -2\nloss_tangent = 0.01\n",
            "materials.glass.loss_tangent needs an eps_r above 0; write eps_r = [eps', eps''] instead"),
      glass("permittivity_zero", half_space + "eps_r = 0\n", "materials.glass.eps_r must not be 0; vacuum has 1"),
      glass("permittivity_without_real_part", half_space + "eps_r = [0, 3]\n",
            "materials.glass.eps_r must not be 0; vacuum has 1"),
      glass("permeability_zero", half_space + "eps_r = 2\nmu_r = 0\n", "materials.glass.mu_r must not be 0"),
      glass("permittivity_of_1e300", half_space + "eps_r = 1e300\n",
            "materials.glass.eps_r: eps_r is 1e+300 in size at 10 GHz, which is not a medium's; correct it"),
      glass("conductivity_of_1e300", half_space + "eps_r = 1\nconductivity_s_per_m = 1e300\n",
            "materials.glass.eps_r: eps_r is 1.8e+300 in size at 10 GHz, which is not a medium's; correct it"),
      glass("of_negative_index_without_loss", half_space + "eps_r = -2\nmu_r = -1.5\n",
            "materials.glass.eps_r: eps_r and mu_r are both below 0 at 10 GHz; give one of them a loss"),
      glass("permittivity_nan", half_space + "eps_r = nan\n", "materials.glass.eps_r must be a finite number"),
      glass("permittivity_text", half_space + "eps_r = \"4\"\n", "materials.glass.eps_r must be a number, or [real part, loss]"),
      glass("permittivity_of_three", half_space + "eps_r = [4, 1, 1]\n",
            "materials.glass.eps_r must be a number, or [real part, loss]"),
      glass("loss_twice", half_space + "eps_r = [4, 1]\nloss_tangent = 0.1\n",
            "materials.glass.loss_tangent cannot be combined with a loss in eps_r; write eps_r = 4"),
      glass("loss_tangent_and_conductivity", half_space + "eps_r = 4\nloss_tangent = 0.1\nconductivity_s_per_m = 1\n",
            "materials.glass.conductivity_s_per_m cannot be combined with loss_tangent; remove one of them"),
      glass("permittivity_and_table", half_space + "eps_r = 4\ntable_csv = \"a.csv\"\n",
            "materials.glass.table_csv cannot be combined with eps_r; remove one of them"),
      glass("table_and_permeability", half_space + "mu_r = 4\ntable_csv = \"a.csv\"\n",
            "materials.glass.mu_r cannot be combined with table_csv, which says it; remove one of them"),
      glass("table_and_library", half_space + "medium = \"glass\"\ntable_csv = \"a.csv\"\n",
            "materials.glass.medium cannot be combined with table_csv; remove one of them"),
      glass("library_knows_it_not", half_space + "medium = \"unobtainium\"\n",
            "materials.glass.medium \"unobtainium\" is not in the library; write "),
      glass("library_knows_it_in_small_letters", half_space + "medium = \"Glass\"\n",
            "materials.glass.medium \"Glass\" is not in the library; write \"glass\""),
      glass("table_without_name", half_space + "table_csv = \"\"\n",
            "materials.glass.table_csv is empty; give the file of the table"),
      glass("table_missing", half_space + "table_csv = \"none.csv\"\n",
            ", line 12: materials.glass.table_csv: none.csv cannot be read; name a readable CSV file"),
      glass("table_is_a_folder", half_space + "table_csv = \".\"\n", "cannot be read; name a readable CSV file"),
      glass("table_is_a_device", half_space + "table_csv = \"/dev/zero\"\n",
            "/dev/zero cannot be read; name a readable CSV file"),
  };
}

BadRow table(const std::string& name, const std::string& bytes, const std::string& says) {
  const std::string words =
      "run case.toml --set target.material=glass --set materials.glass.kind=dielectric --set materials.glass.table_csv=glass.csv";
  return with_file("medium_" + name, "glass.csv", bytes, words, says);
}

std::vector<BadRow> table_rows() {
  const std::string header = "freq_ghz,eps_real,eps_loss\n";
  return {
      table("of_no_bytes", "",
            ": the header must be \"freq_ghz,eps_real,eps_loss\" or \"freq_ghz,eps_real,eps_loss,mu_real,mu_loss\""),
      table("of_other_columns", "freq_hz,eps_real,eps_loss\n1e9,4,0\n2e10,4,0\n", ": the header must be \"freq_ghz"),
      table("of_half_a_permeability", "freq_ghz,eps_real,eps_loss,mu_real\n1,4,0,1\n20,4,0,1\n",
            ": the header must be \"freq_ghz"),
      table("without_rows", header, ": a table of a medium needs at least two rows; write eps_r"),
      table("of_one_row", header + "10,4,0\n", ": a table of a medium needs at least two rows; write eps_r"),
      table("row_short", header + "1,4,0\n20,4\n", ", line 3: 2 values where the header names 3 columns; correct the line"),
      table("row_of_1e300_ghz", header + "1,4,0\n1e300,4,0\n", ", line 3: freq_ghz is too large; write the frequency in GHz"),
      table("row_of_text", header + "1,four,0\n20,4,0\n", ", line 2, column eps_real: \"four\" is not a finite number; write"),
      table("row_of_nan", header + "1,4,nan\n20,4,0\n", ", line 2, column eps_loss: \"nan\" is not a finite number; write"),
      table("descending", header + "20,4,0\n1,4,0\n", ", line 3: freq_ghz must ascend; sort the rows and drop repeated ones"),
      table("row_twice", header + "1,4,0\n20,4,0\n20,5,0\n", ", line 4: freq_ghz must ascend"),
      table("frequency_zero", header + "0,4,0\n20,4,0\n", ", line 2: freq_ghz must be greater than 0; correct the line"),
      table("with_gain", header + "1,4,0\n20,4,-0.5\n",
            ", line 3: eps_loss has a gain: in eps_r = eps' - j eps'' (e^{+jwt}) losses are not below 0; write 0.5"),
      table("with_magnetic_gain", "freq_ghz,eps_real,eps_loss,mu_real,mu_loss\n1,4,0,1,0\n20,4,0.5,1,-1\n",
            ", line 3: mu_loss has a gain: in mu_r = mu' - j mu'' (e^{+jwt})"),
      table("with_zero", header + "1,0,0\n20,4,0\n", ", line 2: eps_real must not be 0; vacuum has 1"),
      table("ends_below", header + "1,4,0\n9.9,4,0\n",
            "materials.glass.table_csv \"glass.csv\" goes from 1 to 9.9 GHz, but frequency.ghz contains 10; choose frequencies"),
      table("begins_above", header + "10.5,4,0\n20,4,0\n", "goes from 10.5 to 20 GHz, but frequency.ghz contains 10; choose"),
      table("through_zero", header + "5,-1,0\n15,1,0\n", "eps_r is 0 in size at 10 GHz, which is not a medium's; correct it"),
      table("in_utf16",
            std::string("\xFF\xFE"
                        "f\0r\0",
                        6),
            ": is text in UTF-16; save it as UTF-8"),
  };
}

const std::string named_mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng roof\nusemtl tar\nf 1 2 3\ng door\nusemtl wood\nf 1 3 4\n";

const std::string named_target = "[target]\nmesh = \"mesh.obj\"\nunit = \"mm\"\n";

// A run of a mesh with names and two materials, glass and paint.
BadRow place(const std::string& name, const std::string& keys, const std::string& says) {
  return with_file("place_" + name, "bad.toml",
                   named_target + frequency + look +
                       "[materials.glass]\nkind = \"sheet\"\nresistance_ohm = 9\n[materials.paint]\nkind = \"absorber\"\n" + keys,
                   "run bad.toml", says);
}

// The same with another mesh from the command line.
BadRow other_mesh(const std::string& name, const std::string& keys, const std::string& says) {
  BadRow row = place(name, keys, says);
  row.words += " --set target.mesh=mesh.off";
  return row;
}

std::vector<BadRow> with_mesh(std::vector<BadRow> rows) {
  for (BadRow& row : rows)
    row.prepare = [before = row.prepare](const Scratch& scratch) {
      before(scratch);
      scratch.write("mesh.obj", named_mesh);
    };
  return rows;
}

std::vector<BadRow> place_rows() {
  const std::string parts = "[target.parts]\n", facets = "[target.facets]\n";
  return with_mesh({
      place("of_unknown_material", parts + "roof = \"glas\"\n",
            ", line 15: target.parts.roof \"glas\" is no material; add [materials.glas], or did you mean \"glass\"?"),
      place("part_is_a_number", parts + "roof = 1\n", ", line 15: target.parts.roof must be a text in double quotes"),
      place("part_is_not_there", parts + "rof = \"glass\"\n",
            ", line 15: target.parts.rof is not a name in the mesh; did you mean \"roof\"?"),
      place("file_is_not_there", parts + "\"mesh.ob\" = \"glass\"\n",
            "target.parts.mesh.ob is not a name in the mesh; did you mean \"mesh.obj\"?"),
      other_mesh(
          "part_went_with_its_mesh", parts + "door = \"glass\"\n",
          "raytube: --set target.mesh=mesh.off: this mesh has no part \"door\", to which bad.toml, line 15 gives a material in "
          "target.parts; to do without these parts add --set 'target.parts={}', or choose among"),
      other_mesh("file_went_with_its_parts", parts + "\"mesh.obj\" = \"glass\"\n",
                 "to do without these parts add --set 'target.parts={}', or did you mean \"mesh.off\"?"),
      other_mesh(
          "facet_went_with_its_mesh", facets + "paint = [[0, 5]]\n",
          "raytube: --set target.mesh=mesh.off: this mesh has 2 facets, counted from 0, but target.facets.paint names facet 5 "
          "(bad.toml, line 15); add --set 'target.facets={}'"),
      place("names_of_two_materials", parts + "roof = \"glass\"\ntar = \"paint\"\n",
            ": facet 0 of the mesh goes by the names \"roof\" and \"tar\", which have the materials \"glass\" and \"paint\" in "
            "target.parts; remove one of them there"),
      place("facets_of_unknown_material", facets + "pant = [0]\n",
            ", line 15: target.facets.pant is no material; add [materials.pant], or did you mean \"paint\"?"),
      place("facets_is_a_number", facets + "paint = 0\n", "target.facets.paint must be a list of facets and ranges"),
      place("facets_none", facets + "paint = []\n",
            "target.facets.paint is an empty list; give at least one facet, or remove it"),
      place("facet_beyond", facets + "paint = [0, 2]\n",
            ", line 15: target.facets.paint names facet 2, but the mesh has 2, counted from 0; choose among these"),
      place("facet_beyond_in_a_range", facets + "paint = [[0, 9007199254740992]]\n",
            "names facet 9007199254740992, but the mesh has 2"),
      place("facet_negative", facets + "paint = [-1]\n", "must be a whole number, counted from 0 (found -1)"),
      place("facet_half", facets + "paint = [0.5]\n", "must be a whole number, counted from 0 (found 0.5)"),
      place("facet_1e300", facets + "paint = [1e300]\n", "must be a whole number, counted from 0 (found 1e+300)"),
      place("facet_range_backwards", facets + "paint = [[1, 0]]\n", "target.facets.paint has the range [1, 0]; write [0, 1]"),
      place("facet_range_of_three", facets + "paint = [[0, 1, 2]]\n", "has a range that is not [first, last]; write"),
      place("facet_of_two_materials", facets + "paint = [[0, 1]]\nglass = [1]\n",
            "target.facets gives facet 1 both to \"paint\" and to \"glass\"; remove it from one of them"),
      place("of_a_medium", parts + "roof = \"Wood\"\n",
            ", line 15: target.parts.roof \"Wood\" is a medium, not a material; add [materials.wood] with a kind and medium = "
            "\"wood\", and name that here"),
      place("part_with_dots", parts + "mesh.obj = \"paint\"\n",
            ", line 15: a name with dots needs quotes; write parts.\"mesh.obj\" = \"paint\" under [target]"),
      place("own_pec", "[materials.pec]\nkind = \"pec\"\n", ", line 14: materials.pec is defined already; choose another name"),
      place("own_absorber", "[materials.absorber]\nkind = \"sheet\"\nresistance_ohm = 9\n",
            "materials.absorber is defined already; choose another name"),
  });
}

std::vector<BadRow> section_rows() {
  const auto set = [](const std::string& name, const std::string& value, const std::string& says) {
    return BadRow{"materials_" + name, "run case.toml --set '" + value + "'", says};
  };
  return {
      set("is_a_number", "materials=3", "materials must be a section; write [materials.NAME] for each material"),
      set("has_a_number", "materials.steel=1", "materials.steel must be a section; write [materials.steel]"),
      set("misspelt", "material.steel.kind=pec", "unknown section \"material\"; did you mean \"materials\"?"),
      set("key_below_a_key", "materials.steel.kind.more=pec", "materials.steel.kind must be a text"),
      set("without_kind", "materials.steel.eps_r=4", "materials.steel.kind is missing; write"),
      set("parts_is_a_number", "target.parts=3", "target.parts must be a section; write [target.parts]"),
      set("facets_is_a_list", "target.facets=[3]", "target.facets must be a section; write [target.facets]"),
      set("part_with_dots", "target.parts.mesh.off=pec",
          "a name with dots needs quotes; write --set 'target.parts.\"mesh.off\"=pec'"),
      set("material_of_a_medium", "target.material=glass",
          "target.material \"glass\" is a medium, not a material; add [materials.glass] with a kind and medium = \"glass\""),
      set("part_misspelt", "target.part.roof=pec", "unknown key \"target.part\"; did you mean \"target.parts\"?"),
      set("mesh_of_no_files", "target.mesh=[]", "target.mesh is an empty list; give at least one mesh file"),
      set("mesh_of_a_number", "target.mesh=[\"mesh.off\", 3]", "entry 2 of target.mesh must be a text in double quotes"),
      set("mesh_of_an_empty_name", "target.mesh=[\"mesh.off\", \"\"]",
          "entry 2 of target.mesh is empty; give the file of the mesh"),
      set("mesh_second_missing", "target.mesh=[\"mesh.off\", \"none.stl\"]", "none.stl': not found; check the path"),
      with_file("materials_in_a_case_of_sources", "bad.toml", "[materials.steel]\nkind = \"pec\"\n", "sources bad.toml",
                ", line 1: [materials] belongs to a case for raytube run; run it with that command"),
  };
}

INSTANTIATE_TEST_SUITE_P(Materials, BadTable, ::testing::ValuesIn(material_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(MediumTables, BadTable, ::testing::ValuesIn(table_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(MaterialPlaces, BadTable, ::testing::ValuesIn(place_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(MaterialSections, BadTable, ::testing::ValuesIn(section_rows()), row_name);

}  // namespace
}  // namespace raytube::testing
