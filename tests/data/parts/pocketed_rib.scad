// A rib of an aircraft: two pockets with rounded corners, walls of 2 mm, floor of 1.5 mm, a lightening hole in one. mm.
$fn = 16;
difference() {
  linear_extrude(16) polygon([[0, 0], [118, 0], [118, 40], [95, 60], [0, 60]]);
  translate([2, 2, 1.5]) linear_extrude(30) offset(6) offset(-6) square([55, 56]);
  translate([59, 2, 1.5]) linear_extrude(30) offset(6) offset(-6)
    polygon([[0, 0], [57, 0], [57, 37], [35, 56], [0, 56]]);
  translate([29.5, 30, -1]) cylinder(d = 24, h = 4);
}
