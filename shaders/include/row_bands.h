// A workgroup that goes down the rows of a strip of columns takes a band of them, an even number, from `begin` to
// before `end`. It starts `lead` rows above the band (an even number), whose springs reach into the band; other bands
// store these rows. A short cloth is one band (shared/stream_types.h). The includer has `push.grid`.
struct RowBand {
    int begin, end;
};

RowBand row_band() {
    int count = int(gl_NumWorkGroups.y), height = ((push.grid.y + count - 1) / count + 1) & ~1;
    int begin = int(gl_WorkGroupID.y) * height;
    return RowBand(begin, min(begin + height, push.grid.y));
}

int lead_in(RowBand band, int lead) { return max(band.begin - lead, 0); }

bool is_of(RowBand band, int y) { return y >= band.begin && y < band.end; }
